#include "formats/surface/turned_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace lozenge {

namespace {

/// Twice the triangle's area along its normal; zero where the triangle is less high than `least`.
Vec3d cross_of(const SurfaceView& surface, const std::array<VertexId, 3>& t, double least) {
  const Vec3d a(surface.positions[t[0]]);
  const Vec3d b = Vec3d(surface.positions[t[1]]) - a;
  const Vec3d c = Vec3d(surface.positions[t[2]]) - a;
  const Vec3d cross = b.cross(c);
  const double longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
  return cross.length() > least * longest ? cross : Vec3d(0, 0, 0);
}

}  // namespace

std::vector<TriangleId> turned_triangles(const SurfaceView& surface, double least_height) {
  constexpr double kAgainst = -0.95;  // cosine
  std::vector<Vec3d> normals;
  std::map<std::array<VertexId, 2>, std::size_t> sides;  // [from, to] its triangle
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    normals.push_back(cross_of(surface, surface.triangles[t], least_height));
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
