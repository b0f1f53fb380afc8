#include "stages/export/body_meshes.h"

#include <utility>

#include "formats/patches/source_level.h"

namespace lozenge {

namespace {

constexpr std::uint32_t kUnnumbered = 0xffffffffU;

/// Takes one body's triangles out of the whole surface, numbering its vertices as they come.
class BodyBuilder {
 public:
  BodyBuilder(const ChartedSurface& surface, const FramedSurface& framed, const OriginOf& origin_of, bool has_skin,
              std::vector<std::uint32_t>& number)
      : surface_(surface), framed_(framed), origin_of_(origin_of), has_skin_(has_skin), number_(number) {}

  void add(std::size_t triangle) {
    for (std::size_t c = 0; c < 3; ++c) mesh_.indices.push_back(number_of(triangle, c));
  }

  EngineMesh take() { return std::move(mesh_); }

 private:
  std::uint32_t number_of(std::size_t triangle, std::size_t corner) {
    const std::uint32_t vertex = framed_.indices[3 * triangle + corner];
    if (number_[vertex] != kUnnumbered) return number_[vertex];
    number_[vertex] = static_cast<std::uint32_t>(mesh_.positions.size());
    const FrameVertex& frame = framed_.vertices[vertex];
    const VertexId at = framed_.positions[vertex];
    mesh_.positions.push_back(surface_.positions[at]);
    mesh_.normals.push_back(frame.normal);
    mesh_.tangents.push_back(frame.tangent_with_sign());
    mesh_.texcoords.push_back(frame.texcoord);
    if (!surface_.origins.empty()) mesh_.origins.push_back(origin_of_(triangle, corner));
    if (has_skin_) {
      const float* influence = &surface_.influences[kInfluences.components * static_cast<std::size_t>(at)];
      mesh_.influences.insert(mesh_.influences.end(), influence, influence + kInfluences.components);
    }
    return number_[vertex];
  }

  const ChartedSurface& surface_;
  const FramedSurface& framed_;
  const OriginOf& origin_of_;
  bool has_skin_;
  std::vector<std::uint32_t>& number_;  ///< [vertex of the whole] in its body, which no other shares
  EngineMesh mesh_;
};

}  // namespace

BodyMeshes body_meshes(const ChartedSurface& surface, const FramedSurface& framed, const Bodies& bodies, Caps caps,
                       const OriginOf& origin_of) {
  std::vector<std::uint32_t> number(framed.vertices.size(), kUnnumbered);
  std::vector<BodyBuilder> builders;
  builders.emplace_back(surface, framed, origin_of, false, number);
  for (const Body& body : bodies.bodies) {
    builders.emplace_back(surface, framed, origin_of, body.skin >= 0 && !surface.influences.empty(), number);
  }
  BodyMeshes made;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const bool on_cap = surface.triangles[t].group == kCapGroup;
    if (on_cap && caps == Caps::kOpen) ++made.cap_triangles;
    else builders[bodies.owner_of(surface.triangles[t].patch) + 1].add(t);
  }
  for (BodyBuilder& builder : builders) made.meshes.push_back(builder.take());
  return made;
}

}  // namespace lozenge
