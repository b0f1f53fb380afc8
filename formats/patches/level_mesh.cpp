// Samples of equal bits are one vertex: a table of bits gives each its number, in the order in which they first come.
#include "formats/patches/level_mesh.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>

namespace lozenge {

namespace {

struct Bits {
  std::uint32_t x, y, z;
  friend bool operator==(const Bits&, const Bits&) = default;
};
struct HashBits {
  std::size_t operator()(const Bits& b) const {
    std::uint64_t h = b.x * 0x9E3779B97F4A7C15ull;
    h = (h ^ (h >> 32) ^ b.y) * 0xD6E8FEB86659FD93ull;
    h = (h ^ (h >> 32) ^ b.z) * 0x9E3779B97F4A7C15ull;
    return h ^ (h >> 29);
  }
};

Bits bits_of(const Vec3f& p) {
  return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

/// Welds the samples of all patches; `position` takes (patch, i, j).
template <typename Position>
LevelMesh weld(PatchGrids grids, const std::vector<PatchPlace>& places, Position position) {
  LevelMesh mesh;
  mesh.grids = std::move(grids);
  mesh.vertices.assign(mesh.grids.size(), -1);
  std::unordered_map<Bits, std::int32_t, HashBits> known;
  known.reserve(mesh.vertices.size());
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto patch = static_cast<std::int32_t>(p);
    const std::int32_t samples = mesh.grids.samples(patch);
    const bool half = !places[p].right.exists();
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < (half ? j + 1 : samples); ++i) {
        const Vec3f at = position(patch, i, j);
        const auto [found, fresh] = known.emplace(bits_of(at), static_cast<std::int32_t>(mesh.positions.size()));
        if (fresh) mesh.positions.push_back(at);
        mesh.vertices[mesh.grids.index(patch, i, j)] = found->second;
      }
    }
    for_each_patch_triangle(samples, half, [&](const auto& a, const auto& b, const auto& c) {
      mesh.triangles.push_back(
          {mesh.vertex(patch, a[0], a[1]), mesh.vertex(patch, b[0], b[1]), mesh.vertex(patch, c[0], c[1])});
      mesh.patches.push_back(patch);
    });
  }
  return mesh;
}

}  // namespace

LevelMesh level_mesh(const GeometryImage& image, int level) {
  return weld(PatchGrids(image.layout, level), image.layout.places,
              [&](std::int32_t patch, std::int32_t i, std::int32_t j) { return image.position(level, patch, i, j); });
}

LevelMesh patch_mesh(const PatchSet& patches) {
  return weld(patches.grids, patches.layout.places, [&](std::int32_t patch, std::int32_t i, std::int32_t j) {
    return patches.positions[patches.index(patch, i, j)];
  });
}

std::vector<std::int32_t> irregular_vertices(const LevelMesh& mesh) {
  // Around an inner vertex every neighbour ends one side and starts another; around one on the boundary, the first and
  // the last do only one of both.
  struct Link {
    std::int32_t from, to;
    auto operator<=>(const Link&) const = default;
  };
  std::vector<Link> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (int s = 0; s < 3; ++s) sides.push_back({t[s], t[(s + 1) % 3]});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::int32_t> triangles(mesh.positions.size(), 0);
  std::vector<bool> on_boundary(mesh.positions.size(), false);
  for (const Link& side : sides) {
    ++triangles[side.from];
    if (!std::binary_search(sides.begin(), sides.end(), Link{side.to, side.from})) {
      on_boundary[side.from] = true;
      on_boundary[side.to] = true;
    }
  }
  std::vector<std::int32_t> found;
  for (std::size_t v = 0; v < triangles.size(); ++v) {
    if (triangles[v] != (on_boundary[v] ? 4 : 6)) found.push_back(static_cast<std::int32_t>(v));
  }
  return found;
}

}  // namespace lozenge
