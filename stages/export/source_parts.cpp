// Corners of one part are numbered by all that a vertex has; tangents are then summed over the triangles of a vertex,
// as those of the resampled levels are (formats/patches/tangent_frame.h).
#include "stages/export/source_parts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/source_level.h"
#include "formats/patches/tangent_frame.h"
#include "formats/surface/distinct_positions.h"

namespace lozenge {

namespace {

bool same_place(const PatchPlace& a, const PatchPlace& b) {
  return a.a == b.a && a.b == b.b && a.left == b.left && a.right == b.right;
}

void require_own_map(const SourceSurface& source, const PatchLayout& patches) {
  const std::vector<PatchPlace> places = patch_places(source.map->domain);
  if (std::equal(places.begin(), places.end(), patches.places.begin(), patches.places.end(), same_place)) return;
  throw Error(ExitCode::kUnusableInput,
              patches.origin +
                  ": the geometry image wasn't sampled from this map; give the map file that `lozenge "
                  "sample` was given");
}

/// A vertex of a mesh by all that it has but the tangent: the surface's vertex, texture coordinates, normal.
using VertexKey = std::array<std::uint32_t, 6>;

struct KeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::size_t hash = 0xcbf29ce484222325U;
    for (const std::uint32_t word : key) hash = (hash ^ word) * 0x100000001b3U;
    return hash ^ (hash >> 29);
  }
};

/// Numbers the vertices of one part as its triangles come.
class PartBuilder {
 public:
  PartBuilder(const ChartedSurface& surface, const MapLayout& layout) : surface_(surface), layout_(layout) {}

  void add(const ChartedTriangle& t) {
    for (const ChartedCorner& corner : t.corners) mesh_.indices.push_back(number_of(t.patch, corner));
  }

  EngineMesh take() {
    number_ = {};
    for (const Vec3f& t : vertex_tangents(mesh_.positions, mesh_.normals, mesh_.texcoords, mesh_.indices)) {
      mesh_.tangents.emplace_back(t.x, t.y, t.z, kBitangentSign);
    }
    return std::move(mesh_);
  }

 private:
  std::uint32_t number_of(std::int32_t patch, const ChartedCorner& corner) {
    const Vec2f uv(layout_.texcoord(patch, corner.place.x, corner.place.y));
    const Vec3f& n = corner.carried;
    const VertexKey key{static_cast<std::uint32_t>(corner.vertex), std::bit_cast<std::uint32_t>(uv.x),
                        std::bit_cast<std::uint32_t>(uv.y),        std::bit_cast<std::uint32_t>(n.x),
                        std::bit_cast<std::uint32_t>(n.y),         std::bit_cast<std::uint32_t>(n.z)};
    const auto [at, is_new] = number_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.push_back(surface_.positions[corner.vertex]);
      mesh_.normals.push_back(n);
      mesh_.texcoords.push_back(uv);
      if (!surface_.influences.empty()) {
        const float* influence = &surface_.influences[kInfluences.components * static_cast<std::size_t>(corner.vertex)];
        mesh_.influences.insert(mesh_.influences.end(), influence, influence + kInfluences.components);
      }
    }
    return at->second;
  }

  const ChartedSurface& surface_;
  const MapLayout& layout_;
  std::unordered_map<VertexKey, std::uint32_t, KeyHash> number_;
  EngineMesh mesh_;
};

}  // namespace

std::int64_t SourceParts::triangle_count() const {
  std::int64_t count = 0;
  for (const EngineMesh& part : parts) count += part.triangle_count();
  return count;
}

SourceParts source_parts(const SourceSurface& source, const PatchLayout& patches, const MapLayout& layout, Caps caps) {
  require_own_map(source, patches);
  ChartedSurface surface = source_level(*source.mesh, *source.map, patches, layout);
  make_distinct(surface.positions);
  SourceParts made;
  made.part_of_patch = parts_of_patches(patches.adjacency);
  const auto count = static_cast<std::size_t>(
      made.part_of_patch.empty() ? 0 : *std::max_element(made.part_of_patch.begin(), made.part_of_patch.end()) + 1);
  std::vector<PartBuilder> builders(count, PartBuilder(surface, layout));
  made.cap_triangles.assign(count, 0);
  for (const ChartedTriangle& t : surface.triangles) {
    const std::int32_t part = made.part_of_patch[t.patch];
    const bool on_cap = t.group == 1;
    if (on_cap && caps == Caps::kOpen) ++made.cap_triangles[part];
    else builders[part].add(t);
  }
  made.parts.resize(count);
  for_each_index(count, true, [&](std::size_t p) { made.parts[p] = builders[p].take(); });
  return made;
}

}  // namespace lozenge
