#include "formats/surface/canonical_form.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "formats/surface/attribute_streams.h"

namespace lozenge {

std::vector<VertexId> make_canonical(SourceMesh& mesh) {
  std::vector<TriangleId> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  return make_canonical(mesh, std::move(order));
}

std::vector<VertexId> make_canonical(SourceMesh& mesh, std::vector<TriangleId> order) {
  if (!mesh.materials.empty()) {
    std::stable_sort(order.begin(), order.end(),
                     [&](TriangleId a, TriangleId b) { return mesh.materials[a] < mesh.materials[b]; });
    std::sort(mesh.materials.begin(), mesh.materials.end());
  }
  if (!std::is_sorted(order.begin(), order.end())) reorder_triangles(mesh.corner_attributes, order);
  std::vector<VertexId> number(mesh.positions.size(), -1);
  std::vector<Vec3f> positions;
  positions.reserve(mesh.positions.size());
  std::vector<std::array<VertexId, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const TriangleId t : order) {
    auto corners = mesh.triangles[t];
    for (VertexId& v : corners) {
      if (number[v] < 0) {
        number[v] = static_cast<VertexId>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
    triangles.push_back(corners);
  }
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return number;
}

}  // namespace lozenge
