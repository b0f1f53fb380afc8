// The import stage: an asset, whatever its format and its making, becomes one welded surface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "formats/surface/repair_report.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// What becomes of meshes that are placed more than once.
enum class Instances : std::uint8_t {
  kShared,    ///< one surface for all placements that touch nothing else
  kSeparate,  ///< each placement is surface of its own
};

struct ImportOptions {
  /// An asset of more triangles, instances counted, is refused before memory is taken for it.
  std::int64_t max_triangles = 100'000'000;
  /// In bytes, by an estimate from what the file says of its sizes; 0: no limit.
  std::uint64_t max_memory = 0;
  Instances instances = Instances::kShared;
  /// Joints that move a vertex of a skin, the heaviest: 4, or up to 8, of which only some engines take more than 4.
  int joints = 4;
  /// Holes of at most this length around are filled, in percent of the diagonal of the surface's box. A hole that small
  /// is what a scanner missed or a converter dropped: on an asset a metre across, one that a thumb covers. Openings
  /// that somebody made are larger.
  double fill_holes = 2;
  /// Whether a surface that needs any repair, holes included, is refused.
  bool strict = false;
};

/// What the importer left out or changed, for the log.
struct ImportReport {
  std::int64_t instances = 0;            ///< meshes placed by nodes, and by EXT_mesh_gpu_instancing
  std::int64_t repeated_instances = 0;   ///< those of meshes that are placed more than once
  std::int64_t copies = 0;               ///< those that only place the surface of another one again
  std::int64_t dropped_triangles = 0;    ///< two of whose corners weld to one vertex
  std::int64_t ignored_primitives = 0;   ///< points, lines, and polygons of fewer than three corners
  std::int64_t repaired_attributes = 0;  ///< normals, UVs and colours that weren't numbers or out of range
  bool was_repaired = false;             ///< the file is one of our own
  std::int64_t deviations = 0;           ///< of the file from its format, which `notes` begins with
  RepairReport repairs;                  ///< of the surface
  std::vector<std::string> notes;        ///< all that in sentences, and what else isn't taken: other scenes, cameras,
                                         ///< lights, animations, skins, extensions that we don't know
};

/// Every triangle of the asset's default scene (of all root nodes, where it has no scene) as one surface in canonical
/// form, meshes that are placed more than once perhaps once: node transforms applied, skins in their rest pose, corners
/// of exactly equal positions welded within each body (SourceMesh::bodies). As it comes: not repaired. \param path  of
/// any format that is read (formats/files/input_format.h) \param result  where not null, is filled in \throws
/// Error(kUnusableInput) where the file is broken, of no format that is read, or has no triangles,
///         Error(kUnsupported) where it needs what we don't know, Error(kLimit) where it has too many triangles or
///         takes too much memory
SourceMesh import_asset(const std::filesystem::path& path, const ImportOptions& options = {},
                        const Progress& progress = {}, ImportReport* result = nullptr);

}  // namespace lozenge
