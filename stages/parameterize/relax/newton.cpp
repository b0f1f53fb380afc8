// Each triangle's energy is expanded to second order in the positions of its corners, its Hessian without the negative
// eigenvalues, which are known in closed form; their sum is one sparse matrix, factored by Cholesky. A line search
// follows.
#include "stages/parameterize/relax/newton.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/relax/sweeps.h"

namespace lozenge {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector4 = Eigen::Matrix<double, 4, 1>;
using Matrix4 = Eigen::Matrix<double, 4, 4>;
using Matrix46 = Eigen::Matrix<double, 4, 6>;

/// Gradient and Hessian of a triangle's energy, by the positions of its corners in the frames of their homes.
struct TriangleExpansion {
  Vector6 gradient;
  Matrix6 hessian;
};

/// A triangle's linear map, x -> z x + w conj(x) in complex numbers: T = 2 |z|^2 + 2 |w|^2 and d = |z|^2 - |w|^2.
struct LinearMap {
  Vector4 zw;             ///< (Re z, Im z, Re w, Im w)
  Matrix46 from_corners;  ///< how it changes with the corners, in the triangle's frame
};

LinearMap linear_map(const RestShape& rest, const FlatImage& p, double scale) {
  // The columns of the map, in a frame whose first axis lies along the side from corner 0 to 1 of the source triangle:
  // first (p1 - p0) + mixed (p2 - p0), and second (p2 - p0).
  const double root = std::sqrt(scale);
  const double first = std::sqrt(static_cast<double>(rest.weight[0]) + rest.weight[2]);
  const double mixed = -rest.weight[0] / first;
  const double second = rest.inverse_area / first;
  const std::array<Vec2d, 3> of_corner{Vec2d(-first - mixed, -second) * root, Vec2d(first, 0) * root,
                                       Vec2d(mixed, second) * root};
  LinearMap map;
  map.zw.setZero();
  for (int c = 0; c < 3; ++c) {
    const auto [x, y] = std::pair(of_corner[c].x / 2, of_corner[c].y / 2);
    map.from_corners.block<4, 2>(0, 2 * c) << x, y, -y, x, x, -y, y, x;
    map.zw += map.from_corners.block<4, 2>(0, 2 * c) * Eigen::Vector2d(p[c].x, p[c].y);
  }
  return map;
}

/// Of the symmetric matrix ((a, b), (b, c)), the nearest one without negative eigenvalues.
Eigen::Matrix2d made_positive(double a, double b, double c) {
  const double middle = (a + c) / 2;
  const double half = std::hypot((a - c) / 2, b);
  Eigen::Matrix2d m;
  m << a, b, b, c;
  if (middle - half >= 0) return m;
  if (middle + half <= 0) return Eigen::Matrix2d::Zero();
  // What is left is the larger eigenvalue's share.
  m.diagonal().array() -= middle - half;
  return m * ((middle + half) / (2 * half));
}

/// The energy depends on |z| and |w| alone, so that its Hessian's eigenvectors are known: i z, i w, and two in the
/// plane of z and w. Negative eigenvalues are left out.
Matrix4 positive_hessian(const EnergyDerivatives<double>& e, const Vector4& zw) {
  const double z = zw.head<2>().norm();
  const double w = zw.tail<2>().norm();
  const double around_z = 4 * e.f_t + 2 * e.f_d;
  const double around_w = 4 * e.f_t - 2 * e.f_d;
  const Eigen::Matrix2d along = made_positive(around_z + 4 * z * z * (e.f_dd + 4 * e.f_td), -4 * z * w * e.f_dd,
                                              around_w + 4 * w * w * (e.f_dd - 4 * e.f_td));
  const Eigen::Vector2d n = zw.head<2>() / z;  // z > w >= 0
  const Eigen::Vector2d m = w > 0 ? Eigen::Vector2d(zw.tail<2>() / w) : Eigen::Vector2d(1, 0);
  const auto turned = [](const Eigen::Vector2d& v) { return Eigen::Vector2d(-v.y(), v.x()); };
  Matrix4 h;
  h.topLeftCorner<2, 2>() =
      std::max(around_z, 0.0) * turned(n) * turned(n).transpose() + along(0, 0) * n * n.transpose();
  h.bottomRightCorner<2, 2>() =
      std::max(around_w, 0.0) * turned(m) * turned(m).transpose() + along(1, 1) * m * m.transpose();
  h.topRightCorner<2, 2>() = along(0, 1) * n * m.transpose();
  h.bottomLeftCorner<2, 2>() = h.topRightCorner<2, 2>().transpose();
  return h;
}

/// The projection onto the side that a free vertex of the boundary lies on.
Eigen::Matrix2d along_boundary(const WorkingMap& map, VertexId v) {
  const Vec2d d = direction_of(boundary_place(map, v).side.side);
  return Eigen::Vector2d(d.x, d.y) * Eigen::RowVector2d(d.x, d.y);
}

/// From the frames of the corners' homes into the triangle's; of a corner on the boundary, what lies along its side.
void turn_home(const WorkingMap& map, TriangleId t, Matrix46& from_corners) {
  for (int c = 0; c < 3; ++c) {
    const int sixths = map.chart[3 * t + c].sixths;
    const double cos = kCosOfSixths[sixths];
    const double sin = kSinOfSixths[sixths];
    Eigen::Matrix2d turn;
    turn << cos, -sin, sin, cos;
    const VertexId v = map.mesh.triangles[t][c];
    if (map.pin[v] < 0 && map.mesh.on_boundary(v)) turn *= along_boundary(map, v);
    const Eigen::Matrix<double, 4, 2> of_corner = from_corners.block<4, 2>(0, 2 * c) * turn;
    from_corners.block<4, 2>(0, 2 * c) = of_corner;
  }
}

TriangleExpansion expand(const WorkingMap& map, TriangleId t, double scale) {
  const RestShape& rest = map.rest[t];
  LinearMap linear = linear_map(rest, flat_image(map, t), scale);
  turn_home(map, t, linear.from_corners);
  const Vector4& zw = linear.zw;
  const double z2 = zw.head<2>().squaredNorm();
  const double w2 = zw.tail<2>().squaredNorm();
  const EnergyDerivatives<double> e = differentiate(map.energy, 2 * (z2 + w2), z2 - w2);
  Vector4 gradient;
  gradient << (4 * e.f_t + 2 * e.f_d) * zw.head<2>(), (4 * e.f_t - 2 * e.f_d) * zw.tail<2>();
  const Matrix46 raised = positive_hessian(e, zw) * linear.from_corners;
  return {rest.share * (linear.from_corners.transpose() * gradient),
          rest.share * (linear.from_corners.transpose() * raised)};
}

/// The largest share of the step, at most 1, before a triangle has lost nine tenths of its area.
double longest_step(const WorkingMap& map, TriangleId t, const std::vector<Vec2d>& step) {
  const FlatImage p = flat_image(map, t);
  std::array<Vec2d, 3> s;
  for (int c = 0; c < 3; ++c) {
    const UnitMotion& chart = map.chart[3 * t + c];
    s[c] = UnitMotion{chart.sixths, {}}(step[map.mesh.triangles[t][c]]);
  }
  // The doubled area after a share x of the step: a x^2 + b x + c.
  const Vec2d u = p[1] - p[0], v = p[2] - p[0], du = s[1] - s[0], dv = s[2] - s[0];
  const double a = cross(du, dv);
  const double b = cross(u, dv) + cross(du, v);
  const double c = 0.9 * cross(u, v);
  const double under = b * b - 4 * a * c;
  if (under < 0) return 1;
  // The smallest positive root, without cancellation.
  const double q = -0.5 * (b + std::copysign(std::sqrt(under), b));
  double least = 1;
  for (const double root : {a != 0 ? q / a : -1, q != 0 ? c / q : -1}) {
    if (root > 0) least = std::min(least, root);
  }
  return least;
}

class Newton {
 public:
  explicit Newton(WorkingMap& map) : map_(map), unknown_(map.home.size(), -1) {
    for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
      if (map.home[v] >= 0 && map.pin[v] < 0) unknown_[v] = count_++;
    }
    for (TriangleId t = 0; t < map.mesh.triangle_count(); ++t) {
      if (!map.mesh.removed(t)) triangles_.push_back(t);
    }
  }

  struct Step {
    double fallen = 0;   ///< by how much the energy fell
    bool whole = false;  ///< it went all of its way
  };

  Step step(double before) {
    const std::vector<Vec2d> direction = solve();
    if (direction.empty()) return {};
    double share = 1;
    for (const TriangleId t : triangles_) share = std::min(share, longest_step(map_, t, direction));
    const std::vector<Vec2d> start = map_.at;
    for (int halving = 0; halving < 12; ++halving, share /= 2) {
      for (std::size_t v = 0; v < start.size(); ++v) map_.at[v] = start[v] + direction[v] * share;
      const double after = total_energy(map_);
      if (!(after < before)) continue;
      go_home(map_, start);
      return {before - after, share == 1};
    }
    map_.at = start;
    return {};
  }

 private:
  std::vector<Vec2d> solve() {
    const double scale = map_.scale();
    std::vector<TriangleExpansion> expansions(triangles_.size());
    for_each_part(triangles_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        expansions[i] = expand(map_, triangles_[i], scale);
      }
    });
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(2 * count_);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(triangles_.size() * 21);
    for (std::size_t i = 0; i < triangles_.size(); ++i) add(triangles_[i], expansions[i], gradient, entries);
    hold_across_boundary(entries);
    Eigen::SparseMatrix<double> hessian(2 * count_, 2 * count_);
    hessian.setFromTriplets(entries.begin(), entries.end());
    // Where every triangle around is at its least, nothing holds a vertex: a hair of its own diagonal does.
    for (int k = 0; k < hessian.outerSize(); ++k) hessian.coeffRef(k, k) *= 1 + 1e-9;
    if (!analyzed_) solver_.analyzePattern(hessian);
    analyzed_ = true;
    solver_.factorize(hessian);
    if (solver_.info() != Eigen::Success) return {};
    const Eigen::VectorXd x = solver_.solve(-gradient);
    if (!x.allFinite()) return {};
    std::vector<Vec2d> direction(map_.at.size(), Vec2d(0, 0));
    for (std::size_t v = 0; v < direction.size(); ++v) {
      if (unknown_[v] >= 0) direction[v] = {x[2 * unknown_[v]], x[2 * unknown_[v] + 1]};
    }
    return direction;
  }

  /// Nothing pulls a vertex of the boundary across its side, and so that nothing is all that moves it, a spring holds
  /// it.
  void hold_across_boundary(std::vector<Eigen::Triplet<double>>& entries) const {
    for (VertexId v = 0; v < map_.mesh.vertex_count(); ++v) {
      const int i = unknown_[v];
      if (i < 0 || !map_.mesh.on_boundary(v)) continue;
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along_boundary(map_, v);
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b <= a; ++b) entries.emplace_back(2 * i + a, 2 * i + b, across(a, b));
      }
    }
  }

  /// The lower triangle of the sum.
  void add(TriangleId t, const TriangleExpansion& e, Eigen::VectorXd& gradient,
           std::vector<Eigen::Triplet<double>>& entries) const {
    for (int c = 0; c < 3; ++c) {
      const int i = unknown_[map_.mesh.triangles[t][c]];
      if (i < 0) continue;
      for (int axis = 0; axis < 2; ++axis) gradient[2 * i + axis] += e.gradient[2 * c + axis];
      for (int other = 0; other < 3; ++other) {
        const int j = unknown_[map_.mesh.triangles[t][other]];
        if (j < 0 || j > i) continue;
        for (int a = 0; a < 2; ++a) {
          for (int b = 0; b < 2; ++b) {
            if (2 * j + b <= 2 * i + a) entries.emplace_back(2 * i + a, 2 * j + b, e.hessian(2 * c + a, 2 * other + b));
          }
        }
      }
    }
  }

  WorkingMap& map_;
  std::vector<std::int32_t> unknown_;  ///< [vertex] or -1
  std::int32_t count_ = 0;
  std::vector<TriangleId> triangles_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
  bool analyzed_ = false;
};

}  // namespace

double newton_all(WorkingMap& map, const NewtonOptions& options) {
  Newton newton(map);
  const double start = total_energy(map);
  if (!std::isfinite(start)) return 0;
  double energy = start;
  for (int i = 0; i < options.most_steps; ++i) {
    const auto [fallen, whole] = newton.step(energy);
    energy -= fallen;
    if (fallen <= (whole ? std::sqrt(options.tolerance) : options.tolerance) * (energy - 1)) break;
  }
  return start - energy;
}

}  // namespace lozenge
