// Levels are chosen and made one by one, each split into what is placed as a whole; maps are encoded once and shared by
// all files.
#include "stages/export/export.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/base/utf8.h"
#include "formats/patches/patch_grids.h"
#include "stages/export/asset_levels.h"
#include "stages/export/asset_writer.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/looks.h"
#include "stages/export/morph_deltas.h"
#include "stages/export/own_space.h"

namespace lozenge {
namespace {

/// "17 samples a side (28800 triangles), 9 (7200), 5 (1800)"
std::string available_levels(const GeometryImage& image) {
  std::string list;
  for (int level = 0; level < static_cast<int>(image.levels.size()); ++level) {
    list += fmt::format("{}{}{} ({} triangles)", level == 0 ? "" : ", ", image.levels[level].samples,
                        level == 0 ? " samples a side" : "", image.layout.count_triangles(level));
  }
  return list;
}

[[noreturn]] void refuse_level(const GeometryImage& image, const std::string& wish) {
  throw Error(ExitCode::kUsage, fmt::format("{}: no level of detail has {}; there are {}", image.layout.origin, wish,
                                            available_levels(image)));
}

/// Where UVs point without a map: to the texels of the finest level of the geometry image itself; where parts have
/// scales of their own, each to a tile of its size.
MapLayout own_layout(const GeometryImage& image) {
  MapLayout layout;
  layout.tile = image.layout.samples;
  layout.columns = image.columns;
  layout.counts[0] = image.size();
  if (image.layout.first_levels.empty()) {
    layout.width = layout.columns * layout.tile;
    layout.height = layout.rows() * layout.tile;
    return layout;
  }
  const std::int64_t all_of_the_finest = std::int64_t{image.columns} * image.layout.samples;
  return make_map_layout(image.layout,
                         static_cast<std::int32_t>(
                             std::clamp<std::int64_t>(all_of_the_finest, least_map_size(image.layout), kMostMapSize)),
                         0);
}

/// The layout that the maps of the material share.
MapLayout common_layout(const GeometryImage& image, const std::vector<const BakedMap*>& maps) {
  if (maps.empty()) return own_layout(image);
  const MapLayout& layout = maps.front()->layout;
  if (!layout.fits(image.layout)) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("{}: the {} map has {} tiles of other sizes than the {} patches of the geometry image; bake "
                    "the maps from this image",
                    image.layout.origin, traits_of(maps.front()->kind).name, layout.patches(), image.size()));
  }
  for (const BakedMap* map : maps) {
    if (map->layout != layout) {
      throw Error(ExitCode::kUnusableInput,
                  fmt::format("{}: the {} map and the {} map have different layouts; bake them in one run",
                              image.layout.origin, traits_of(maps.front()->kind).name, traits_of(map->kind).name));
    }
  }
  return layout;
}

/// Those that a material has a slot for, in the order of their kinds.
std::vector<const BakedMap*> maps_of_material(const BakedMaps& maps) {
  std::vector<const BakedMap*> found;
  for (const MapTraits& traits : kMapKinds) {
    if (traits.slots.front() == MaterialSlot::kNone) continue;
    const bool is_in_another = traits.kind == MapKind::kOcclusion && maps.find(MapKind::kOcclusionRoughnessMetal);
    if (is_in_another) continue;
    if (const BakedMap* map = maps.find(traits.kind)) found.push_back(map);
  }
  return found;
}

/// Those of fitted levels, each for its own, then those of the whole asset.
std::vector<MaterialMap> encoded(const AssetLevels& levels, const std::vector<const BakedMap*>& maps,
                                 const TextureEncoding& encoding) {
  std::vector<std::pair<const BakedMap*, std::int32_t>> all;
  for (std::size_t l = 0; l < levels.facts.size(); ++l) {
    for (const BakedMap& map : levels.facts[l].maps) all.emplace_back(&map, static_cast<std::int32_t>(l));
  }
  for (const BakedMap* map : maps) all.emplace_back(map, -1);
  std::vector<MaterialMap> pictures(all.size());
  for_each_index(all.size(), true, [&](std::size_t i) {
    const auto& [map, level] = all[i];
    pictures[i] = {map->kind, encoded_texture(*map, encoding)};
    pictures[i].level = level;
  });
  return pictures;
}

/// The maps that the file of these levels has.
std::vector<MaterialMap> maps_of_levels(const std::vector<MaterialMap>& maps, std::size_t first, std::size_t count) {
  std::vector<MaterialMap> chosen;
  for (const MaterialMap& map : maps) {
    const auto level = static_cast<std::size_t>(std::max(map.level, 0));
    if (map.level >= 0 && (level < first || level >= first + count)) continue;
    chosen.push_back(map);
    if (map.level >= 0) chosen.back().level = static_cast<std::int32_t>(level - first);
  }
  return chosen;
}

/// The map of tangent-space normals, or null.
const BakedMap* normals_in_frames(const GeometryImage& image, const BakedMaps& maps) {
  const BakedMap* map = maps.find_in_level_frames();
  if (map != nullptr && (map->level < 0 || map->level >= static_cast<std::int32_t>(image.levels.size()))) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("{}: the normal map was baked for level of detail {}, the geometry image has {}; bake it from "
                    "this image",
                    image.layout.origin, map->level, image.levels.size()));
  }
  return map;
}

/// Refuses what no GLB can hold before memory is asked for it.
void require_room(const GeometryImage& image, int finest) {
  constexpr std::int64_t kBytesOfAVertex = sizeof(Vec3f) + sizeof(Vec3f) + sizeof(Vec4f) + sizeof(Vec2f);
  constexpr std::int64_t kBytesOfATriangle = 3 * sizeof(std::uint32_t);
  const std::int64_t samples = image.levels[finest].samples;
  const std::int64_t triangles = image.layout.count_triangles(finest);
  const auto vertices = static_cast<std::int64_t>(PatchGrids(image.layout, finest).size());
  const std::int64_t bytes = vertices * kBytesOfAVertex + triangles * kBytesOfATriangle;
  if (bytes > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitCode::kLimit,
                fmt::format("{}: {} patches of {} samples a side ({} triangles) don't fit in the 4 GB of "
                            "a GLB; choose fewer samples or a budget of triangles",
                            image.layout.origin, image.size(), samples, triangles));
  }
}

std::filesystem::path file_of_level(std::filesystem::path path, std::size_t level) {
  const std::string name = fmt::format("{}.lod{}{}", path.stem().string(), level, path.extension().string());
  return path.replace_filename(name);
}

/// Levels of detail in a file: which is the finest, and how many there are.
struct LevelRange {
  std::size_t first = 0;
  std::size_t count = 1;
};

/// What is no map because it is the same everywhere is a factor.
void take_constants(const std::vector<ConstantMap>& constants, Appearance& appearance) {
  Material& factors = appearance.factors;
  for (const auto& [kind, value] : constants) {
    switch (kind) {
      case MapKind::kBaseColour:
        factors.base_colour = {value[0], value[1], value[2], value[3]};
        break;
      case MapKind::kOcclusionRoughnessMetal:
        factors.roughness = value[1];
        factors.metallic = value[2];
        break;
      case MapKind::kEmissive:
        factors.emissive = {value[0], value[1], value[2]};
        factors.emissive_strength = appearance.emissive_strength;
        break;
      default:
        break;
    }
  }
}

/// What the file of these levels says about itself.
AssetOrigin origin_of(const GeometryImage& image, const AssetLevels& levels, LevelRange range,
                      const SourceSurface* source, const BakedMaps& baked) {
  const std::int32_t samples = image.levels[levels.facts[range.first].level].samples;
  AssetOrigin origin{image.layout.scene_name, image.layout.origin, image.size(), samples};
  origin.is_fitted = source != nullptr;
  if (source != nullptr) origin.appearance = appearance_of(*source->mesh);
  origin.constants = baked.constants();
  take_constants(origin.constants, origin.appearance);
  origin.translation = image.layout.translation;
  for (const PatchPlace& place : image.layout.places) origin.half_patches += place.right.exists() ? 0 : 1;
  for (std::size_t l = range.first; l < std::min(range.first + range.count, levels.facts.size()); ++l) {
    if (source == nullptr) {
      origin.boundary_sides.push_back(count_boundary_sides(image, levels.facts[l].level));
    }
    origin.cap_triangles += levels.facts[l].cap_triangles;
  }
  origin.source_triangles = levels.facts[range.first].source_triangles;
  return origin;
}

/// \return [level of the range] its vertices
std::vector<std::int64_t> write_levels(const std::filesystem::path& path, const GeometryImage& image,
                                       const AssetLevels& levels, LevelRange range,
                                       const std::vector<MaterialMap>& maps, const SourceSurface* source,
                                       const Looks& looks, const BakedMaps& baked, const ExportOptions& options) {
  const Rig& rig = source == nullptr ? Rig() : source->mesh->rig;
  std::vector<AssetPart> parts;
  for (const LeveledPart& part : levels.parts) {
    if (part.levels.size() <= range.first) continue;
    const std::span levels_of_part = std::span(part.levels).subspan(range.first);
    parts.push_back(
        {valid_utf8(part.body.name), levels_of_part.first(std::min(range.count, levels_of_part.size())), part.body});
  }
  return write_asset(path, parts, maps_of_levels(maps, range.first, range.count),
                     origin_of(image, levels, range, source, baked), rig, looks, options);
}

/// A part that has fewer levels shows its last one on all others.
std::int64_t triangles_of_level(const AssetLevels& levels, int level) {
  std::int64_t triangles = 0;
  for (const LeveledPart& part : levels.parts) {
    const std::size_t l = std::min(static_cast<std::size_t>(level), part.levels.size() - 1);
    triangles += part.levels[l].triangle_count();
  }
  return triangles;
}

std::size_t most_levels(const AssetLevels& levels) {
  std::size_t most = 0;
  for (const LeveledPart& part : levels.parts) most = std::max(most, part.levels.size());
  return most;
}

LevelQuality quality_of(const AssetLevels& levels, int level) {
  LevelQuality quality;
  quality.triangles = triangles_of_level(levels, level);
  if (const auto& deviations = levels.facts[static_cast<std::size_t>(level)].deviations) {
    const LevelDeviation& whole = deviations->whole;
    const double percent = whole.extent > 0 ? 100 / whole.extent : 0;
    quality.mean_distance_percent = percent * whole.mean;
    quality.max_distance_percent = percent * whole.largest;
    quality.normal_angle = whole.normals;
  }
  return quality;
}

/// Where the finest level has more triangles than there were to be.
std::string note_on_budget(const GeometryImage& image, const ExportOptions& options, std::int64_t triangles) {
  if (options.triangle_budget == 0 || triangles <= options.triangle_budget) return "";
  return fmt::format(
      "{}: its finest level has {} triangles instead of at most {}, the fewest that it can have; a domain "
      "of fewer faces leaves room for fewer",
      image.layout.origin, triangles, options.triangle_budget);
}

/// Welded: vertices at one place are one again. Those of different parts are at different places.
void add_surface(const EngineMesh& mesh, AssetFacts& facts) {
  if (mesh.indices.empty()) return;
  std::vector<unsigned int> remap(mesh.positions.size());
  const std::size_t places = meshopt_generateVertexRemap(remap.data(), nullptr, remap.size(), mesh.positions.data(),
                                                         mesh.positions.size(), sizeof(Vec3f));
  const std::size_t first = facts.positions.size();
  facts.positions.resize(first + places);
  for (std::size_t v = 0; v < remap.size(); ++v) facts.positions[first + remap[v]] = mesh.positions[v];
  const auto vertex = [&](std::size_t c) { return static_cast<VertexId>(first + remap[mesh.indices[c]]); };
  for (std::size_t c = 0; c < mesh.indices.size(); c += 3) {
    facts.surface.push_back({vertex(c), vertex(c + 1), vertex(c + 2)});
  }
}

}  // namespace

int level_to_export(const GeometryImage& image, const ExportOptions& options) {
  const int count = static_cast<int>(image.levels.size());
  int level = 0;
  if (options.samples != 0) {
    while (level < count && image.levels[level].samples != options.samples) ++level;
    if (level == count) refuse_level(image, fmt::format("{} samples a side", options.samples));
  }
  if (options.triangle_budget < 0) throw Error(ExitCode::kUsage, "a budget of triangles can't be negative");
  if (options.triangle_budget != 0) {
    while (level + 1 < count && image.layout.count_triangles(level) > options.triangle_budget) ++level;
  }
  return level;
}

AssetFacts export_asset(const std::filesystem::path& path, const GeometryImage& image, const BakedMaps& maps,
                        const ExportOptions& wanted, const SourceSurface* source) {
  ExportOptions options = wanted;
  if (options.lods_as == LodsAs::kFiles && options.coarser_levels) {
    options.separate_files = true;
    options.coarser_levels = false;
  }
  const int finest = level_to_export(image, options);
  require_room(image, finest);
  std::vector<const BakedMap*> of_material = maps_of_material(maps);
  const MapLayout layout = common_layout(image, of_material);
  const BakedMap* normals = normals_in_frames(image, maps);
  AssetLevels levels = make_levels(image, layout, finest, of_material, normals, options, source);
  if (source != nullptr) std::erase(of_material, normals);  // fitted levels have frames of their own
  const std::vector<MaterialMap> textures = encoded(levels, of_material, options.textures);
  const std::size_t count = most_levels(levels);

  AssetFacts facts;
  facts.level = finest;
  facts.samples = image.levels[finest].samples;
  facts.cap_triangles = levels.facts.front().cap_triangles;
  facts.source_triangles = levels.facts.front().source_triangles;
  for (const LeveledPart& part : levels.parts) {
    facts.triangles += part.levels.front().triangle_count();
    facts.copies += static_cast<std::int64_t>(part.body.places.size()) - 1;
    if (source == nullptr) continue;
    add_surface(part.levels.front().sampled, facts);
    add_surface(part.levels.front().source, facts);
  }
  const Rig& rig = source == nullptr ? Rig() : source->mesh->rig;
  if (source != nullptr) add_morph_deltas(levels.parts, *source->mesh);
  move_to_own_spaces(levels.parts, rig, image.layout.translation);
  add_tangent_deltas(levels.parts);
  facts.levels = options.coarser_levels ? static_cast<std::int32_t>(count) : 1;
  for (int l = 0; l < facts.levels; ++l) {
    facts.level_qualities.push_back(quality_of(levels, l));
    facts.level_triangles.push_back(facts.level_qualities.back().triangles);
  }
  facts.note = note_on_budget(image, options, facts.triangles);
  facts.files.push_back(path);
  const Looks looks(image, layout, source);
  const std::vector<std::int64_t> vertices = write_levels(
      path, image, levels, {0, static_cast<std::size_t>(facts.levels)}, textures, source, looks, maps, options);
  for (std::size_t l = 0; l < facts.level_qualities.size(); ++l) facts.level_qualities[l].vertices = vertices[l];
  facts.vertices = vertices.front();
  for (std::size_t l = 1; options.separate_files && l < count; ++l) {
    facts.files.push_back(file_of_level(path, l));
    write_levels(facts.files.back(), image, levels, {l, 1}, textures, source, looks, maps, options);
  }
  return facts;
}

}  // namespace lozenge
