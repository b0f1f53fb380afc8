#include "stages/import/pieces.h"

#include "formats/base/disjoint_sets.h"

namespace lozenge {

std::vector<VertexId> pieces_of(const SourceMesh& mesh) {
  DisjointSets<VertexId> sets(mesh.positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  std::vector<VertexId> pieces(mesh.positions.size());
  for (std::size_t v = 0; v < pieces.size(); ++v) pieces[v] = sets.root(static_cast<VertexId>(v));
  return pieces;
}

std::vector<double> piece_areas(const SourceMesh& mesh) {
  const std::vector<VertexId> pieces = pieces_of(mesh);
  std::vector<double> areas(pieces.size(), 0);
  for (const auto& triangle : mesh.triangles) areas[pieces[triangle[0]]] += triangle_area(mesh.positions, triangle);
  for (std::size_t v = 0; v < areas.size(); ++v) areas[v] = areas[pieces[v]];
  return areas;
}

}  // namespace lozenge
