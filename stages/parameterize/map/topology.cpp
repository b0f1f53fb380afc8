// Euler's formula gives the genus once the boundary's loops are counted, and with it the number of a triangulation's
// triangles for the fewest vertices that it can have.
#include "stages/parameterize/map/topology.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lozenge {

namespace {

std::int64_t count_loops(const HalfedgeMesh& mesh) {
  std::vector<char> seen(mesh.outgoing.size(), 0);
  std::int64_t loops = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.outgoing[v] < 0 || !mesh.on_boundary(v) || seen[v]) continue;
    ++loops;
    for (VertexId w = v; !seen[w]; w = mesh.end(mesh.outgoing[w])) seen[w] = 1;
  }
  return loops;
}

}  // namespace

Topology topology_of(const HalfedgeMesh& mesh) {
  const auto vertices = mesh.vertex_count() - std::count(mesh.outgoing.begin(), mesh.outgoing.end(), -1);
  const auto removed =
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [](const auto& t) { return t[0] < 0; });
  const std::int64_t triangles = mesh.triangle_count() - removed;
  std::int64_t ends = 0;  // half-edges without a twin
  for (Halfedge h = 0; h < static_cast<Halfedge>(mesh.twins.size()); ++h) {
    ends += !mesh.removed(h / 3) && mesh.twins[h] < 0;
  }
  const std::int64_t euler = vertices - (3 * triangles + ends) / 2 + triangles;
  const std::int64_t loops = count_loops(mesh);
  return {(2 - loops - euler) / 2, loops};
}

std::int32_t least_domain_faces(const Topology& topology) {
  const auto& [genus, loops] = topology;
  const double bound = (7 + std::sqrt(1.0 + 48.0 * static_cast<double>(genus))) / 2;
  const std::int64_t closed = genus == 0 ? 4 : genus == 2 ? 10 : static_cast<std::int64_t>(std::ceil(bound - 1e-9));
  if (loops == 0) return static_cast<std::int32_t>(2 * closed - 4 + 4 * genus);
  const std::int64_t vertices = std::max(3 * loops, closed - loops);
  // Fewest where all vertices lie on the boundary.
  return static_cast<std::int32_t>(vertices - 4 + 4 * genus + 2 * loops);
}

}  // namespace lozenge
