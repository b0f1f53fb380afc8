// What a run made and what it cost: the report that `build --report` writes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/domain/distortion.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_set.h"
#include "formats/surface/repair_report.h"
#include "formats/surface/surface_facts.h"
#include "stages/export/export.h"

namespace lozenge {

struct StageCost {
  std::string name;
  double seconds = 0;
  /// Largest resident memory of the process while the stage ran, in 10^6 bytes. Where the system can't forget an
  /// earlier peak (it has no /proc/self/clear_refs), the largest since the process began.
  double peak_memory_mb = 0;
};

/// Meshes of an asset, each time that its scene places them.
struct InstanceFacts {
  std::int64_t placed = 0;
  std::int64_t repeated = 0;  ///< of meshes that are placed more than once
  std::int64_t copies = 0;    ///< of those, what only places the surface of another one again
};

struct DomainFacts {
  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
  std::int64_t irregular_vertices = 0;
  /// No domain of the surface's topology has fewer triangles; 0 where that was not looked at.
  std::int64_t least_triangles = 0;
  /// The numbers that were looked for, from the first to the last; 0 where that isn't known.
  std::array<std::int64_t, 2> asked{};
  /// [k] how many parts have domain triangles scaled by 2^-k; empty where that was not looked at.
  std::vector<std::int64_t> parts_by_first_level;
};
DomainFacts domain_facts(const Domain& domain);

struct PatchFacts {
  std::int64_t count = 0;
  std::int64_t samples = 0;  ///< N
  std::int64_t levels = 0;   ///< of detail
};
PatchFacts patch_facts(const PatchSet& patches);
PatchFacts patch_facts(const GeometryImage& image);

/// Of the finest level of detail in the asset, and its distance to the source where that was measured: the mean and the
/// largest of the two ways, in percent of the source's box diagonal.
struct AssetQuality {
  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
  std::int64_t source_triangles = 0;  ///< of those, the source's own
  std::int64_t levels = 0;            ///< of detail in the file
  std::vector<LevelQuality> level_qualities;
  std::optional<double> mean_distance_percent;
  std::optional<double> max_distance_percent;
  std::optional<double> boundary_max_distance_percent;  ///< between the two boundaries, where the surface has one
};

AssetQuality asset_quality(const AssetFacts& facts);

/// A level of detail where animations take it: mean distances to the source, the larger way, in percent of the diagonal
/// of the source's box.
struct PosedLevel {
  double rest_percent = 0;
  double worst_percent = 0;    ///< of the poses that were looked at
  std::int32_t animation = 0;  ///< where that was, of those of the source
  double time = 0;             ///< seconds
};

struct PosedFacts {
  std::int64_t poses = 0;
  std::vector<PosedLevel> levels;  ///< of the asset, finest first
};

/// A command fills in what it knows.
struct QualityReport {
  std::optional<SurfaceFacts> source;
  std::optional<InstanceFacts> instances;
  std::optional<RepairReport> repairs;
  std::optional<DomainFacts> domain;
  std::optional<Distortion> distortion;
  std::optional<PatchFacts> patches;
  std::optional<AssetQuality> asset;
  std::optional<PosedFacts> poses;  ///< where the source has animations
  std::optional<BakeStatistics> bake;
  std::vector<StageCost> stages;
  double seconds = 0;
  double peak_memory_mb = 0;
  std::string input;  ///< as the user named it
};

/// As a JSON object. Its keys are an interface: source {vertices, triangles, components, euler, boundary_loops,
/// boundary_edges}, instances {placed, repeated, copies}, repairs {KIND: {count, where [[x, y, z]]}} with the kinds
/// that there were and their first places, domain {triangles, vertices, irregular_vertices}, distortion {area, angle,
/// aggregate, l2_stretch, folded_triangles, area_sum_error}, patches {count, samples, levels}, asset {triangles,
/// vertices, source_triangles, levels, level_triangles, lods [{triangles, mean_distance_percent, max_distance_percent,
/// normals_degrees}], mean_distance_percent, max_distance_percent, boundary_max_distance_percent}, poses {count, levels
/// [{rest_mean_percent, worst_mean_percent, animation, time}]}, bake {texels, rays, rays_per_second, fallback_texels,
/// unused_texels, cage_distance, dark_share, map_size}, stages
/// [{name, seconds, peak_memory_mb}], seconds, peak_memory_mb, lozenge (the version), input. What isn't known is left
/// out.
std::string report_json(const QualityReport& report);

/// The same for people.
std::vector<std::string> report_lines(const QualityReport& report);

/// \throws Error(kUsage) where the file can't be written
void write_report(const std::filesystem::path& path, const QualityReport& report);

}  // namespace lozenge
