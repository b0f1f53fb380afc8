// The source's boundary vertices lie on the domain's sides, each at some share of one. For each sample the vertices
// within a step of it are choices, and staying is one; of all ways to choose in order, the one whose polyline keeps
// nearest to the source's boundary is found from one end to the other (dynamic programming).
#include "stages/sample/boundary_corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/surface/boundary.h"

namespace lozenge {

namespace {

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
  const Vec3d along = b - a;
  const double squared = along.length2();
  const double share = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0;
  return (p - (a + along * share)).length();
}

}  // namespace

std::optional<PlaceOnSide> place_on_boundary(const Domain& domain, const DomainPoint& p) {
  const LatticePoint at = lattice_point(p);
  const std::array<std::int64_t, 3> weights{kLatticeOne - at.u - at.v, at.u, at.v};
  for (int s = 0; s < 3; ++s) {
    const std::int64_t along = weights[(s + 1) % 3];
    if (weights[(s + 2) % 3] != 0 || domain.neighbour({p.triangle, s}).exists()) continue;
    if (along == 0 || along == kLatticeOne) continue;
    return PlaceOnSide{{p.triangle, s}, static_cast<double>(along) / static_cast<double>(kLatticeOne)};
  }
  return std::nullopt;
}

BoundaryCorners::BoundaryCorners(const SourceMesh& mesh, const Parameterization& map)
    : mesh_(mesh), on_side_(3 * map.domain.triangles.size()) {
  const std::vector<BoundarySide> sides = boundary_sides(mesh.triangles);
  if (sides.empty()) return;
  for (TriangleId t = 0; t < static_cast<TriangleId>(mesh.triangles.size()); ++t) {
    for (int c = 0; c < 3; ++c) {
      const VertexId v = mesh.triangles[t][c];
      // Once for each vertex: in the triangle whose side leaves it along the boundary.
      if (!std::binary_search(sides.begin(), sides.end(), BoundarySide{v, mesh.triangles[t][(c + 1) % 3]})) continue;
      const auto place = place_on_boundary(map.domain, map.phi[v]);
      if (!place) continue;
      Corner corner{place->along, {t, Vec3d(0, 0, 0)}};
      corner.source.weights[c] = 1;
      on_side_[3 * place->side.triangle + place->side.side].push_back(corner);
    }
  }
  for (std::vector<Corner>& corners : on_side_) {
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.along < b.along; });
  }
}

namespace {

/// A place that a sample may take.
struct Choice {
  double along = 0;
  Vec3d at;
  std::optional<SourcePoint> corner;
  double cost = 0;   ///< of the best polyline that ends here
  int previous = 0;  ///< the choice of the sample before on it
};

}  // namespace

std::vector<std::optional<SourcePoint>> BoundaryCorners::places(DomainSide side, const std::vector<double>& along,
                                                                const std::vector<Vec3f>& regular) const {
  // In steps. The order along the boundary is kept, so no triangle turns over, however far a sample slides.
  constexpr double kReach = 0.9;
  constexpr double kApart = 0.1;
  const std::vector<Corner>& corners = on_side_[3 * side.triangle + side.side];
  const std::size_t count = along.size();
  std::vector<std::optional<SourcePoint>> chosen(count);
  if (corners.empty()) return chosen;
  std::vector<Vec3d> at;
  for (const Corner& corner : corners) at.emplace_back(position_at(mesh_, corner.source));
  const double step = along[1] - along[0];
  std::vector<std::vector<Choice>> choices(count);
  for (std::size_t k = 0; k < count; ++k) {
    choices[k].push_back({along[k], Vec3d(regular[k]), std::nullopt});
    for (std::size_t c = 0; c < corners.size() && k > 0 && k + 1 < count; ++c) {
      if (std::abs(corners[c].along - along[k]) < kReach * step)
        choices[k].push_back({corners[c].along, at[c], corners[c].source});
    }
  }
  // The largest distances count most.
  const auto cost_between = [&](const Choice& p, const Choice& q) {
    double most = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (corners[c].along > p.along && corners[c].along < q.along)
        most = std::max(most, distance_to_segment(at[c], p.at, q.at));
    }
    return most * most * most * most;
  };
  for (std::size_t k = 1; k < count; ++k) {
    for (Choice& here : choices[k]) {
      here.cost = std::numeric_limits<double>::infinity();
      for (std::size_t p = 0; p < choices[k - 1].size(); ++p) {
        if (here.along - choices[k - 1][p].along < kApart * step) continue;
        const double cost = choices[k - 1][p].cost + cost_between(choices[k - 1][p], here);
        if (!(cost < here.cost)) continue;
        here.cost = cost;
        here.previous = static_cast<int>(p);
      }
    }
  }
  int choice = 0;
  for (std::size_t k = count; k-- > 0;) {
    chosen[k] = choices[k][choice].corner;
    choice = choices[k][choice].previous;
  }
  return chosen;
}

}  // namespace lozenge
