// The export stage: a geometry image and its maps become the asset that an engine loads (one GLB).
//
// Every level of detail is one mesh of one primitive, and one more for each further body (what a skin or a node moves,
// or the source's scene places more than once): positions, normals, tangents and UVs over the atlas of the maps. All
// share one material, but for what no texture can say (looks.h): that are further primitives. Each patch has vertices
// of its own, because its UVs are its own; along the border of two patches their positions are equal bit by bit, so the
// mesh is watertight once equal positions are welded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/files/compression.h"
#include "formats/files/texture_encoding.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// What becomes of the caps of holes that the importer filled.
enum class Caps : std::uint8_t {
  kKeep,  ///< they are surface like any other
  kOpen,  ///< they are left out: the holes are open again
};

/// What the finest level of detail in the file is.
enum class Finest : std::uint8_t {
  kAuto,     ///< the source's own triangles where they are no more than the resampled ones, and known
  kSource,   ///< the source's own triangles, cut along the borders of patches
  kSamples,  ///< the patches' samples
};

/// How levels of detail are told apart.
enum class LodsAs : std::uint8_t {
  kMsftLod,  ///< in one file, as alternatives of its nodes: extension MSFT_lod
  kNodes,    ///< in one file, as siblings NAME_LOD0, NAME_LOD1, ..., all in the scene
  kFiles,    ///< each in a file of its own, NAME.glb, NAME.lod1.glb, ...
};

/// Whose maps fitted levels of detail show, besides those of normals, which are always their own.
enum class LevelMapsOf : std::uint8_t {
  kLevels,  ///< their own, seen from their surfaces, each of about half the side of those of the level before
  kAsset,   ///< those of the whole asset
};

/// Numbers of vertices.
enum class VertexFormat : std::uint8_t {
  kFloat,
  kQuantized,  ///< `quantize_vertices`
};

/// The surface that the geometry image was sampled from, and its map.
struct SourceSurface {
  const SourceMesh* mesh = nullptr;
  const Parameterization* map = nullptr;
};

/// As many coarser levels as there are down to some hundred triangles.
inline constexpr std::int32_t kAsManyAsUseful = -1;

struct ExportOptions {
  /// Samples a side of the finest level in the file: 2^k + 1, at most those of the geometry image. 0: those.
  std::int32_t samples = 0;
  /// The finest level in the file has at most this many triangles, or as few as it can have. 0: no limit.
  std::int64_t triangle_budget = 0;
  /// Where the finest level is the source's own, the resampled ones are the coarser levels, of which only those are in
  /// the file that have fewer triangles; and on each, a part of fewer triangles in the source keeps those.
  Finest finest = Finest::kAuto;
  /// Where samples are known to lie farther from the source (root mean square), in percent of the diagonal of its
  /// bounding box, they are no match for its own triangles.
  double error = kUsualError;
  /// Where there are coarser levels.
  LodsAs lods_as = LodsAs::kMsftLod;
  /// Where levels are fitted to the source.
  LevelMapsOf level_maps = LevelMapsOf::kLevels;
  VertexFormat vertex_format = VertexFormat::kFloat;
  Compression compression = Compression::kNone;
  /// Coarser levels in the same file.
  bool coarser_levels = true;
  /// How many of the coarser levels at most, each of about a quarter of the triangles of the one before.
  std::int32_t max_coarser_levels = kAsManyAsUseful;
  /// Each coarser level also as a file of its own beside the first, complete with its maps: NAME.lod1.glb,
  /// NAME.lod2.glb, ...
  bool separate_files = false;
  TextureEncoding textures{};  ///< in the file
  /// Where caps are left out, a triangle goes that has most of its corners on one; so a hole has the resolution of the
  /// samples, and may be closed at coarser levels.
  Caps caps = Caps::kKeep;
};

/// One level of detail, all parts of it.
struct LevelQuality {
  std::int64_t triangles = 0;  ///< those of repeated meshes once
  std::int64_t vertices = 0;   ///< in the file: those on borders once for each patch
  /// Distances to the source, the larger of both ways, in percent of the diagonal of its box; nothing where it isn't
  /// known.
  std::optional<double> mean_distance_percent;
  std::optional<double> max_distance_percent;
  /// Mean angle between the source's normals and those that the level shows with its map, radians; nothing where there
  /// is no map, or the level's normals are the source's.
  std::optional<double> normal_angle;
};

/// What the file holds.
struct AssetFacts {
  std::int32_t level = 0;             ///< of the geometry image: the finest one in the file
  std::int32_t samples = 0;           ///< a side, there
  std::int64_t triangles = 0;         ///< of the finest level, those of repeated meshes once
  std::int64_t cap_triangles = 0;     ///< of the finest level, that are left out
  std::int64_t vertices = 0;          ///< of the finest level, in the file: those on borders once for each patch
  std::int64_t copies = 0;            ///< further places in which repeated meshes are shown
  std::int64_t source_triangles = 0;  ///< of the finest level, that are the source's own
  /// The finest level, all parts of it, where the source is known; else it is the image's.
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> surface;
  std::int32_t levels = 1;                    ///< of detail, in the first file
  std::vector<std::int64_t> level_triangles;  ///< [level in the first file]
  std::vector<LevelQuality> level_qualities;  ///< of the same
  std::string note;                           ///< what isn't as it was asked for; or nothing
  std::vector<std::filesystem::path> files;   ///< all that were written, the first one first
};

/// The level of the geometry image that `options` ask for: of a budget of triangles that none keeps to, the coarsest.
///
/// \throws Error(kUsage) where no level has the samples; says which ones there are
int level_to_export(const GeometryImage& image, const ExportOptions& options);

/// Writes the asset to `path`. Maps that glTF's material has a slot for (map_kinds.h) become its textures,
/// inside the file; other maps are left out. What no map says are the factors of the source's materials.
///
/// \param source  null where it isn't known: the finest level is a resampled one then, and all stands as it does at
/// rest;
///                else bodies are in their own spaces, at the nodes and skins of its rig, with its animations
/// \throws Error(kUsage) where the options ask for a level that isn't there, or the source's without it, or a file
/// can't be written; Error(kUnusableInput) where the maps are of another atlas than the image, or the source isn't
/// the image's, or nothing would be left without its caps;
/// Error(kLimit) where the asset would pass the 4 GB of a GLB
AssetFacts export_asset(const std::filesystem::path& path, const GeometryImage& image, const BakedMaps& maps,
                        const ExportOptions& options = {}, const SourceSurface* source = nullptr);

}  // namespace lozenge
