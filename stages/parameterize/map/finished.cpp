// Removed domain triangles and vertices leave gaps in the numbers, which are closed; every vertex is rounded to the
// lattice, on the domain's boundary along its side, so that it stays on it.
#include "stages/parameterize/map/finished.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/boundary.h"

namespace lozenge {

namespace {

/// The nearest point on the lattice that lies on the side.
DomainPoint point_on_side(DomainSide side, double along) {
  const std::int64_t steps = std::llround(std::clamp(along, 0.0, 1.0) * static_cast<double>(kLatticeOne));
  std::array<std::int64_t, 3> weights{};
  weights[side.side] = kLatticeOne - steps;
  weights[(side.side + 1) % 3] = steps;
  return domain_point(side.triangle, {weights[1], weights[2]});
}

/// A vertex's place on the lattice. \param number  [domain triangle] its new one
DomainPoint point_of(const WorkingMap& map, VertexId v, const std::vector<DomainTriangleId>& number) {
  if (map.pin[v] >= 0) {
    const DomainCorner c = map.corner_of[map.pin[v]];
    return corner_point({number[c.triangle], c.corner});
  }
  if (map.mesh.on_boundary(v)) {
    const BoundaryPlace place = boundary_place(map, v);
    return point_on_side({number[place.side.triangle], place.side.side}, place.along);
  }
  const auto b = barycentrics(map.at[v]);
  return make_point(number[map.home[v]], b[0], b[1]);
}

}  // namespace

Parameterization finished(const WorkingMap& map) {
  Parameterization result;
  std::vector<DomainTriangleId> number(map.domain.triangles.size(), -1);
  std::vector<DomainVertex> vertex_number(map.corner_of.size(), -1);
  for (std::size_t t = 0; t < number.size(); ++t) {
    const DomainTriangle& d = map.domain.triangles[t];
    if (d.corners[0] < 0) continue;
    number[t] = result.domain.size();
    result.domain.triangles.push_back(d);
  }
  for (DomainTriangle& d : result.domain.triangles) {
    for (int s = 0; s < 3; ++s) {
      DomainVertex& v = vertex_number[d.corners[s]];
      if (v < 0) v = result.domain.vertex_count++;
      d.corners[s] = v;
      if (d.neighbours[s].exists()) d.neighbours[s].triangle = number[d.neighbours[s].triangle];
    }
  }
  result.phi.resize(map.home.size());
  for_each_part(result.phi.size(), [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < static_cast<VertexId>(end); ++v) {
      if (map.home[v] >= 0) result.phi[v] = point_of(map, v, number);
    }
  });
  return result;
}

}  // namespace lozenge
