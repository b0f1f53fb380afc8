#include "formats/patches/framed_surface.h"

#include <array>
#include <bit>
#include <unordered_map>

namespace lozenge {

namespace {

/// A vertex by all that it has but the tangent: the surface's vertex, texture coordinates, normal.
using VertexKey = std::array<std::uint32_t, 6>;

struct KeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::size_t hash = 0xcbf29ce484222325U;
    for (const std::uint32_t word : key) hash = (hash ^ word) * 0x100000001b3U;
    return hash ^ (hash >> 29);
  }
};

VertexKey key_of(VertexId vertex, const Vec2f& uv, const Vec3f& n) {
  return {static_cast<std::uint32_t>(vertex), std::bit_cast<std::uint32_t>(uv.x), std::bit_cast<std::uint32_t>(uv.y),
          std::bit_cast<std::uint32_t>(n.x),  std::bit_cast<std::uint32_t>(n.y),  std::bit_cast<std::uint32_t>(n.z)};
}

void add_tangents(const ChartedSurface& surface, FramedSurface& framed) {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec2f> texcoords;
  for (std::size_t v = 0; v < framed.vertices.size(); ++v) {
    positions.push_back(surface.positions[framed.positions[v]]);
    normals.push_back(framed.vertices[v].normal);
    texcoords.push_back(framed.vertices[v].texcoord);
  }
  const std::vector<Vec3f> tangents = vertex_tangents(positions, normals, texcoords, framed.indices);
  for (std::size_t v = 0; v < tangents.size(); ++v) framed.vertices[v].tangent = tangents[v];
}

}  // namespace

FramedSurface framed_surface(const ChartedSurface& surface, const MapLayout& layout) {
  FramedSurface framed;
  framed.indices.reserve(3 * surface.triangles.size());
  std::unordered_map<VertexKey, std::uint32_t, KeyHash> number_of;
  for (const ChartedTriangle& t : surface.triangles) {
    for (const ChartedCorner& corner : t.corners) {
      const Vec2f uv(layout.texcoord(t.patch, corner.place.x, corner.place.y));
      const auto [at, is_new] = number_of.try_emplace(key_of(corner.vertex, uv, corner.carried),
                                                      static_cast<std::uint32_t>(framed.vertices.size()));
      if (is_new) {
        framed.vertices.push_back({.normal = corner.carried, .texcoord = uv});
        framed.positions.push_back(corner.vertex);
      }
      framed.indices.push_back(at->second);
    }
  }
  add_tangents(surface, framed);
  return framed;
}

}  // namespace lozenge
