#include "formats/surface/turned_triangles.h"

#include <array>
#include <map>

namespace lozenge {

std::vector<TriangleId> turned_triangles(const SurfaceView& surface) {
  constexpr double kAgainst = -0.95;  // cosine
  std::vector<Vec3d> normals;
  std::map<std::array<VertexId, 2>, std::size_t> sides;  // [from, to] its triangle
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3d p(surface.positions[a]);
    normals.push_back((Vec3d(surface.positions[b]) - p).cross(Vec3d(surface.positions[c]) - p));
    for (int k = 0; k < 3; ++k) sides[{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]}] = t;
  }
  std::vector<TriangleId> turned;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    int against = 0;
    int neighbours = 0;
    for (int k = 0; k < 3; ++k) {
      const auto other = sides.find({surface.triangles[t][(k + 1) % 3], surface.triangles[t][k]});
      if (other == sides.end()) continue;
      const Vec3d& n = normals[other->second];
      ++neighbours;
      if (normals[t].dot(n) < kAgainst * normals[t].length() * n.length()) ++against;
    }
    if (neighbours > 1 && against == neighbours) turned.push_back(static_cast<TriangleId>(t));
  }
  return turned;
}

}  // namespace lozenge
