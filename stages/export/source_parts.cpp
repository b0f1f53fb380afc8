// Corners of one part are numbered by all that a vertex has; tangents are then summed over the triangles of a vertex,
// as those of the resampled levels are (formats/patches/tangent_frame.h).
#include "stages/export/source_parts.h"

#include <algorithm>

#include "formats/base/error.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/source_level.h"

namespace lozenge {

namespace {

constexpr std::uint32_t kUnnumbered = 0xffffffffU;

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

/// Takes one part's triangles out of the whole surface, numbering its vertices as they come.
class PartBuilder {
 public:
  PartBuilder(const SourceMesh& source, const ChartedSurface& surface, const FramedSurface& framed,
              std::vector<std::uint32_t>& number)
      : source_(source), surface_(surface), framed_(framed), number_(number) {}

  void add(std::size_t triangle) {
    for (std::size_t c = 3 * triangle; c < 3 * triangle + 3; ++c)
      mesh_.indices.push_back(number_of(framed_.indices[c], surface_.triangles[triangle].group));
  }

  EngineMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t number_of(std::uint32_t vertex, std::int32_t group) {
    if (number_[vertex] != kUnnumbered) return number_[vertex];
    number_[vertex] = static_cast<std::uint32_t>(mesh_.positions.size());
    const FrameVertex& frame = framed_.vertices[vertex];
    const VertexId at = framed_.positions[vertex];
    mesh_.positions.push_back(surface_.positions[at]);
    mesh_.normals.push_back(frame.normal);
    mesh_.tangents.push_back(frame.tangent_with_sign());
    mesh_.texcoords.push_back(frame.texcoord);
    if (!surface_.origins.empty()) mesh_.origins.push_back(origin_in(surface_.origins[at], bent_triangle(group)));
    if (!surface_.influences.empty()) {
      const float* influence = &surface_.influences[kInfluences.components * static_cast<std::size_t>(at)];
      mesh_.influences.insert(mesh_.influences.end(), influence, influence + kInfluences.components);
    }
    return number_[vertex];
  }

  /// The same place by another triangle that has it; none where that isn't one of the source's (below 0).
  SourcePoint origin_in(const SourcePoint& origin, TriangleId triangle) const {
    if (triangle < 0) return {};
    if (origin.triangle == triangle) return origin;
    SourcePoint same{triangle, Vec3d(0, 0, 0)};
    for (int c = 0; c < 3; ++c) {
      const auto& corners = source_.triangles[triangle];
      const auto corner = std::find(corners.begin(), corners.end(), source_.triangles[origin.triangle][c]);
      if (corner != corners.end()) same.weights[static_cast<int>(corner - corners.begin())] = origin.weights[c];
    }
    return same;
  }

  const SourceMesh& source_;
  const ChartedSurface& surface_;
  const FramedSurface& framed_;
  std::vector<std::uint32_t>& number_;  ///< [vertex of the whole] in its part
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
  const ChartedSurface surface = source_level(*source.mesh, *source.map, patches, layout);
  const FramedSurface framed = framed_surface(surface, layout);
  SourceParts made;
  made.part_of_patch = parts_of_patches(patches.adjacency);
  const auto count = static_cast<std::size_t>(
      made.part_of_patch.empty() ? 0 : *std::max_element(made.part_of_patch.begin(), made.part_of_patch.end()) + 1);
  std::vector<std::uint32_t> number(framed.vertices.size(), kUnnumbered);
  std::vector<PartBuilder> builders(count, PartBuilder(*source.mesh, surface, framed, number));
  made.cap_triangles.assign(count, 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::int32_t part = made.part_of_patch[surface.triangles[t].patch];
    const bool on_cap = surface.triangles[t].group == kCapGroup;
    if (on_cap && caps == Caps::kOpen) ++made.cap_triangles[part];
    else builders[part].add(t);
  }
  for (PartBuilder& builder : builders) made.parts.push_back(builder.take());
  return made;
}

}  // namespace lozenge
