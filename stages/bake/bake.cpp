// Every inner texel of every patch is baked once, into its own place of the map; then borders take the texel of the
// patch that owns them, and gutters that of the neighbour which they continue. Tangent-space normals come last: the
// object-space normal of every texel, gutters too, in the frame of the texel's own patch.
#include "stages/bake/bake.h"

#include <fmt/format.h>

#include <cmath>

#include "formats/base/error.h"
#include "stages/bake/atlas_baker.h"
#include "stages/bake/normal_maps.h"
#include "stages/bake/occlusion_map.h"
#include "stages/bake/position_map.h"

namespace lozenge {

namespace {

constexpr std::int32_t kMostOcclusionRays = 65536;

void require_usable(const BakeOptions& options, const GeometryImage& image) {
  const auto usable_length = [](double length) { return std::isfinite(length) && length >= 0; };
  if (options.level < 0 || options.level >= static_cast<int>(image.levels.size())) {
    throw Error(ExitCode::kUsage, fmt::format("there is no level of detail {}; the geometry image has levels 0 to {}",
                                              options.level, static_cast<int>(image.levels.size()) - 1));
  }
  if (options.cage_distance && !usable_length(*options.cage_distance)) {
    throw Error(ExitCode::kUsage, fmt::format("a cage of {} is no length; give 0 or more", *options.cage_distance));
  }
  if (!usable_length(options.occlusion_distance)) {
    throw Error(ExitCode::kUsage,
                fmt::format("an occlusion distance of {} is no length; give 0 (everything occludes) or more",
                            options.occlusion_distance));
  }
  if (options.occlusion_rays < 1 || options.occlusion_rays > kMostOcclusionRays) {
    throw Error(ExitCode::kUsage, fmt::format("{} occlusion rays a texel are out of range; choose 1 to {}",
                                              options.occlusion_rays, kMostOcclusionRays));
  }
  if (options.occlusion_size < 1) {
    throw Error(ExitCode::kUsage, fmt::format("an occlusion map of {0} x {0} texels can't be made; choose 1 or more",
                                              options.occlusion_size));
  }
}

/// \throws Error where the geometry image's patches are not those of the map's domain
void require_same_patches(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image) {
  const std::vector<DomainSide> domain_edges = edges(map.domain);
  bool same = map.phi.size() == mesh.positions.size() && domain_edges.size() == image.layout.places.size();
  for (std::size_t p = 0; p < domain_edges.size() && same; ++p) {
    same = image.layout.places[p].left == domain_edges[p] &&
           image.layout.places[p].right == map.domain.neighbour(domain_edges[p]);
  }
  if (!same) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("the geometry image ({} patches) and the parameterization of {} ({} domain edges) don't belong "
                    "together; sample and pack this parameterization again",
                    image.layout.places.size(), mesh.origin, domain_edges.size()));
  }
}

/// Which function bakes which kind of map.
class Maps {
 public:
  explicit Maps(AtlasBaker& baker) : baker_(baker) {}

  BakedMap bake(MapKind kind) {
    switch (kind) {
      case MapKind::kTangentNormal:
        return bake_tangent_normals(baker_, object_normals());
      case MapKind::kObjectNormal:
        return object_normals();
      case MapKind::kOcclusion:
        return bake_occlusion(baker_);
      case MapKind::kPosition:
        return bake_positions(baker_);
    }
    throw Error(ExitCode::kInternal, "a kind of map that nothing bakes");
  }

 private:
  /// Baked once, for both maps of normals.
  const BakedMap& object_normals() {
    if (!object_normals_) object_normals_ = bake_object_normals(baker_);
    return *object_normals_;
  }

  AtlasBaker& baker_;
  std::optional<BakedMap> object_normals_;
};

}  // namespace

BakedMaps bake(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
               const BakeOptions& options, const Progress& progress) {
  require_usable(options, image);
  require_same_patches(mesh, map, image);
  report(progress, "preparing to bake", 0);
  AtlasBaker baker(mesh, map, image, options, progress);
  Maps maps(baker);
  BakedMaps result;
  result.level = options.level;
  for (const MapKind kind : options.maps) result.maps.push_back(maps.bake(kind));
  result.statistics = baker.statistics();
  return result;
}

}  // namespace lozenge
