// Every inner texel of every patch is baked once, into its own place of the map; then borders take the texel of the
// patch that owns them, and gutters that of the neighbour which they continue. Tangent-space normals come last: the
// object-space normal of every texel, gutters too, in the frame of the texel's own patch.
#include "stages/bake/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"
#include "formats/patches/shrunk_atlas.h"
#include "stages/bake/atlas_baker.h"
#include "stages/bake/constant_map.h"
#include "stages/bake/material_maps.h"
#include "stages/bake/normal_maps.h"
#include "stages/bake/occlusion_map.h"
#include "stages/bake/position_map.h"
#include "formats/patches/shrunk_map.h"
#include "stages/bake/source_normal_map.h"

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
  if (options.occlusion_distance && !usable_length(*options.occlusion_distance)) {
    throw Error(ExitCode::kUsage,
                fmt::format("an occlusion distance of {} is no length; give 0 or more", *options.occlusion_distance));
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
  Maps(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
       bool with_baked_occlusion)
      : baker_(baker), mesh_(mesh), map_(map), image_(image), with_baked_occlusion_(with_baked_occlusion) {}

  BakedMap bake(MapKind kind) {
    switch (kind) {
      case MapKind::kTangentNormal:
        return tangent_normals();
      case MapKind::kObjectNormal:
        return object_normals();
      case MapKind::kOcclusion:
        return occlusion();
      case MapKind::kPosition:
        return bake_positions(baker_);
      case MapKind::kBaseColour:
        return bake_base_colours(baker_);
      case MapKind::kOcclusionRoughnessMetal:
        return bake_occlusion_roughness_metal(baker_, with_baked_occlusion_ ? &occlusion() : nullptr);
      case MapKind::kEmissive:
        return bake_emission(baker_);
      case MapKind::kSourceNormal:
        return bake_source_normals(baker_, mesh_, map_, image_);
      case MapKind::kClearcoatNormal:
        return bake_clearcoat_normals(baker_, mesh_, map_, image_);
      case MapKind::kAnisotropy:
        return bake_anisotropy(baker_, mesh_, map_, image_);
      case MapKind::kClearcoat:
      case MapKind::kSheen:
      case MapKind::kSpecular:
      case MapKind::kTransmission:
      case MapKind::kIridescence:
        return bake_extension(baker_, kind);
    }
    throw Error(ExitCode::kInternal, "a kind of map that nothing bakes");
  }

 private:
  /// Those in object space are as large: they go where nobody wants them.
  BakedMap tangent_normals() {
    BakedMap made = bake_tangent_normals(baker_, object_normals());
    const std::vector<MapKind>& wanted = baker_.options().maps;
    if (std::find(wanted.begin(), wanted.end(), MapKind::kObjectNormal) == wanted.end()) object_normals_.reset();
    return made;
  }

  /// Baked once, for both maps of normals.
  const BakedMap& object_normals() {
    if (!object_normals_) object_normals_ = bake_object_normals(baker_);
    return *object_normals_;
  }

  /// The same for two maps that have it.
  const BakedMap& occlusion() {
    if (!occlusion_) occlusion_ = bake_occlusion(baker_);
    return *occlusion_;
  }

  AtlasBaker& baker_;
  const SourceMesh& mesh_;
  const Parameterization& map_;
  const GeometryImage& image_;
  bool with_baked_occlusion_;
  std::optional<BakedMap> object_normals_;
  std::optional<BakedMap> occlusion_;
};

std::vector<MapKind> maps_to_bake(const BakeOptions& options, const SourceMesh& mesh) {
  return options.maps.empty() ? usual_maps(options, mesh) : options.maps;
}

/// Whether maps are to hold what rays say of the sky.
bool with_baked_occlusion(const BakeOptions& options, const SourceMesh& mesh) {
  if (std::find(options.maps.begin(), options.maps.end(), MapKind::kOcclusion) != options.maps.end()) return true;
  if (options.occlusion == OcclusionOf::kAuto) return !has_made_look(mesh);
  return options.occlusion == OcclusionOf::kBaked;
}

}  // namespace

std::vector<MapKind> usual_maps(const BakeOptions& options, const SourceMesh& mesh) {
  const Appearance appearance = appearance_of(mesh);
  std::vector<MapKind> maps{MapKind::kTangentNormal};
  if (appearance.has_orm) maps.push_back(MapKind::kOcclusionRoughnessMetal);
  else if (with_baked_occlusion(options, mesh)) maps.push_back(MapKind::kOcclusion);
  if (appearance.has_base_colours) maps.push_back(MapKind::kBaseColour);
  if (appearance.has_emissive) maps.push_back(MapKind::kEmissive);
  if (appearance.has_normals && options.source_level) maps.push_back(MapKind::kSourceNormal);
  for (const MapTraits& traits : kMapKinds) {
    const bool is_there = std::any_of(traits.slots.begin(), traits.slots.end(), [&](MaterialSlot slot) {
      const ExtensionTexture* row = extension_texture(slot);
      return row != nullptr && appearance.has_extension_texture[static_cast<std::size_t>(row->role)];
    });
    if (is_there) maps.push_back(traits.kind);
  }
  return maps;
}

std::int32_t atlas_size(const BakeOptions& options, const PatchLayout& patches) {
  std::int32_t size = options.size != 0 ? options.size : default_map_size(patches);
  for (const MapSize& own : options.sizes) size = std::max(size, own.size);
  return size;
}

std::int32_t map_shrink(const BakeOptions& options, MapKind kind, const MapLayout& layout) {
  std::int32_t wanted = options.size != 0 ? options.size : layout.width;
  for (const MapSize& own : options.sizes) {
    if (own.kind == kind) wanted = own.size;
  }
  const std::int32_t smallest = layout.smallest_tile();
  const std::int32_t most = std::max(layout.gutter_of(smallest), 1);
  std::int32_t shrink = 1;
  while (2 * shrink <= most && layout.width >= 2 * shrink * wanted && smallest % (2 * shrink) == 0) shrink *= 2;
  return shrink;
}

std::string note_on_occlusion(const BakeStatistics& statistics) {
  constexpr double kNearlyAll = 0.9;
  if (statistics.dark_share.value_or(0) < kNearlyAll) return {};
  return fmt::format(
      "{:.0f} % of the surface see less than a tenth of the sky, and its occlusion is nearly black; give "
      "a smaller --occlusion-distance, or --occlusion source",
      100 * *statistics.dark_share);
}

std::string note_on_occlusion_pose(const BakeOptions& options, const BakedMaps& maps, const SourceMesh& mesh) {
  const bool was_traced = maps.statistics.dark_share.has_value();
  if (mesh.rig.empty() || !was_traced) return {};
  return options.occlusion_pose == OcclusionPose::kRest
             ? "occlusion is that of the rest pose; --occlusion-pose modelling looks at each body by itself, where it "
               "was modelled"
             : "occlusion is that of each body by itself, where it was modelled";
}

std::vector<TextureRole> texture_roles(const BakeOptions& options, const SourceMesh& mesh) {
  std::vector<TextureRole> roles;
  if (has_made_look(mesh)) {
    // By which tiles are ordered, whichever maps are baked.
    roles = {TextureRole::kBaseColour, TextureRole::kOcclusion, TextureRole::kMetallicRoughness,
             TextureRole::kEmissive};
  }
  for (const MapKind kind : maps_to_bake(options, mesh)) {
    switch (kind) {
      case MapKind::kTangentNormal:
      case MapKind::kObjectNormal:
      case MapKind::kSourceNormal:
        roles.push_back(TextureRole::kNormal);
        break;
      case MapKind::kBaseColour:
        roles.push_back(TextureRole::kBaseColour);
        break;
      case MapKind::kOcclusionRoughnessMetal:
        roles.push_back(TextureRole::kOcclusion);
        roles.push_back(TextureRole::kMetallicRoughness);
        break;
      case MapKind::kEmissive:
        roles.push_back(TextureRole::kEmissive);
        break;
      case MapKind::kOcclusion:
      case MapKind::kPosition:
        break;
      default:
        for (const MaterialSlot slot : traits_of(kind).slots) {
          if (const ExtensionTexture* row = extension_texture(slot)) roles.push_back(row->role);
        }
        break;
    }
  }
  return roles;
}

BakedMaps bake(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
               const BakeOptions& options, const Progress& progress, const Textures* textures) {
  require_usable(options, image);
  require_same_patches(mesh, map, image);
  report(progress, "preparing to bake", 0);
  AtlasBaker baker(mesh, map, image, options, textures, progress);
  Maps maps(baker, mesh, map, image, with_baked_occlusion(options, mesh));
  BakedMaps result;
  result.level = options.level;
  std::vector<ConstantMap> constants;
  for (const MapKind kind : maps_to_bake(options, mesh)) {
    BakedMap made = maps.bake(kind);
    if (options.maps.empty()) {
      if (const auto constant = constant_of(made, baker.atlas())) {
        constants.push_back(*constant);
        continue;
      }
    }
    if (baker.atlas().layout().order.is_given() && made.shrink == 1 && traits_of(kind).values == MapValues::kShares) {
      baker.continue_beyond_tiles(made);
    }
    // Occlusion has a size of its own already.
    const std::int32_t shrink = made.shrink > 1 ? 1 : map_shrink(options, kind, made.layout);
    if (shrink > 1) {
      made = shrunk(made, shrink);
      if (!is_in_source_frames(kind)) baker.continue_beyond_borders(made);
    }
    result.maps.push_back(std::move(made));
  }
  result.statistics = baker.statistics();
  result.statistics.map_size = baker.atlas().layout().width;
  for (const ConstantMap& constant : constants) result.statistics.constant_maps.push_back(constant.kind);
  if (!result.maps.empty()) result.maps.front().constants = std::move(constants);
  return result;
}

}  // namespace lozenge
