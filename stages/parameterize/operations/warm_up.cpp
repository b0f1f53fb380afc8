// The position of a new vertex is found by a few steps of Levenberg and Marquardt's method on two wishes at once: the
// area around stays what it was, and so do the angles that the triangles have at the rim.
#include "stages/parameterize/operations/warm_up.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/parameterize/map/star.h"

namespace lozenge {

namespace {

double angle(const Vec3d& at, const Vec3d& p, const Vec3d& q) {
  return std::atan2((p - at).cross(q - at).length(), (p - at).dot(q - at));
}

/// A triangle of the rim: its outer side, and where its inner corner was before the collapse.
struct RimTriangle {
  Vec3d first, second, before;
  double first_angle = angle(first, second, before);  ///< before the collapse, at its outer side's ends
  double second_angle = angle(second, before, first);
};

std::vector<RimTriangle> rim_of(const WorkingMap& map, const SurfaceMeasures& m, DomainSide side) {
  std::vector<RimTriangle> rim;
  const DomainSide across = map.domain.neighbour(side);
  const auto add = [&](const std::vector<DomainCorner>& around) {
    for (const DomainCorner& corner : around) {
      if (corner.triangle == side.triangle || corner.triangle == across.triangle) continue;
      const auto& c = map.domain.triangles[corner.triangle].corners;
      const int inner = corner.corner;
      rim.push_back({m.embedding[c[(inner + 1) % 3]], m.embedding[c[(inner + 2) % 3]], m.embedding[c[inner]]});
    }
  };
  for (const DomainVertex n : {map.domain.start(side), map.domain.end(side)}) {
    const bool is_start = n == map.domain.start(side);
    if (valence(map, n).on_boundary) add(star_of(map, n));
    else if (is_start) add(corners_around(map.domain, {side.triangle, side.side}));
    else add(corners_around(map.domain, {across.triangle, across.side}));
  }
  return rim;
}

double area(const Vec3d& p, const Vec3d& q, const Vec3d& r) { return (q - p).cross(r - p).length() / 2; }

/// One residual for the total area, as a share of what it was, and two angles (in radians, of which there are many, so
/// weighed down) for each rim triangle.
Eigen::VectorXd residuals(const std::vector<RimTriangle>& rim, double area_before, const Vec3d& x) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(1 + 2 * rim.size()));
  const double weight = 1 / std::sqrt(2.0 * static_cast<double>(rim.size()));
  double total = 0;
  Eigen::Index i = 1;
  for (const RimTriangle& t : rim) {
    total += area(t.first, t.second, x);
    r[i++] = weight * (angle(t.first, t.second, x) - t.first_angle);
    r[i++] = weight * (angle(t.second, x, t.first) - t.second_angle);
  }
  r[0] = area_before > 0 ? total / area_before - 1 : 0;
  return r;
}

}  // namespace

SurfaceMeasures trivial_measures(const WorkingMap& map) {
  SurfaceMeasures measures;
  measures.vertex_area = voronoi_areas(map);
  measures.embedding.resize(map.anchor.size());
  for (std::size_t v = 0; v < map.anchor.size(); ++v) measures.embedding[v] = Vec3d((*map.positions)[map.anchor[v]]);
  return measures;
}

Vec3d embed_collapsed_vertex(const WorkingMap& map, const SurfaceMeasures& m, DomainSide side) {
  constexpr int kIterations = 4;  // the centre is a source vertex near the position: a rough one does
  const DomainVertex a = map.domain.start(side);
  const DomainVertex b = map.domain.end(side);
  const std::vector<RimTriangle> rim = rim_of(map, m, side);
  double area_before = 0;
  for (const RimTriangle& t : rim) area_before += area(t.first, t.second, t.before);
  for (const DomainSide s : {side, map.domain.neighbour(side)}) {
    if (!s.exists()) continue;
    const auto& c = map.domain.triangles[s.triangle].corners;
    area_before += area(m.embedding[c[0]], m.embedding[c[1]], m.embedding[c[2]]);
  }
  // Levenberg and Marquardt's method from the middle of the side, with differences for derivatives.
  Vec3d x = (m.embedding[a] + m.embedding[b]) / 2;
  const double size = std::max((m.embedding[a] - m.embedding[b]).length(), 1e-30);
  const double step = size * 1e-5;
  Eigen::VectorXd r = residuals(rim, area_before, x);
  double damping = 1e-3;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::MatrixXd jacobian(r.size(), 3);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d moved = x;
      moved[axis] += step;
      jacobian.col(axis) = (residuals(rim, area_before, moved) - r) / step;
    }
    Eigen::Matrix3d normal = jacobian.transpose() * jacobian;
    normal.diagonal().array() += damping * normal.trace() + 1e-12 / (size * size);
    const Eigen::Vector3d d = normal.ldlt().solve(-(jacobian.transpose() * r));
    const Vec3d next = x + Vec3d(d[0], d[1], d[2]);
    const Eigen::VectorXd after = residuals(rim, area_before, next);
    if (after.squaredNorm() < r.squaredNorm()) {
      x = next;
      r = after;
      damping /= 4;
    } else {
      damping *= 8;
    }
  }
  return x;
}

}  // namespace lozenge
