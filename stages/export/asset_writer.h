// The GLB of an asset: parts with levels of detail over one atlas, placed once or more often.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/files/texture_encoding.h"
#include "formats/patches/baked_maps.h"
#include "formats/surface/appearance.h"
#include "formats/surface/bodies.h"
#include "formats/surface/rig.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/export.h"
#include "stages/export/level_deviation.h"
#include "stages/export/looks.h"

namespace lozenge {

/// One level of detail of a part: a primitive of resampled surface, one of the source's own triangles, or both.
struct PartLevel {
  EngineMesh sampled;
  std::optional<LevelDeviation> deviation = {};  ///< where the source is known
  EngineMesh source;  ///< has the source's normals, and a map of tangent-space normals of its own or none

  bool empty() const { return sampled.indices.empty() && source.indices.empty(); }
  std::int64_t triangle_count() const { return sampled.triangle_count() + source.triangle_count(); }
  std::int64_t vertex_count() const {
    return static_cast<std::int64_t>(sampled.positions.size() + source.positions.size());
  }
};

/// What the scene places as a whole.
struct AssetPart {
  std::string name;
  std::span<const PartLevel> levels;  ///< finest first
  Body body;                          ///< where it is shown, and what moves it
};

/// A map of the material.
struct MaterialMap {
  MapKind kind;
  EncodedTexture picture;
  std::int32_t level =
      -1;  ///< in the file, whose resampled triangles alone have it; -1: of all levels that have none of its kind
};

/// What the file says about itself.
struct AssetOrigin {
  std::string scene_name;
  std::string source;  ///< name of the file that the surface came from
  std::int32_t patches = 0;
  std::int32_t samples = 0;       ///< a side, of the finest level in the file
  std::int32_t half_patches = 0;  ///< on the surface's boundary; said where there are any
  /// [level in the file] sides of triangles on the surface's boundary; said where there are half patches.
  std::vector<std::int64_t> boundary_sides = {};
  std::int64_t cap_triangles = 0;  ///< left out of all levels in the file; said where there are any
  std::int64_t source_triangles =
      0;                       ///< of the source's own, in the finest level in the file; said where there are any
  bool is_fitted = false;      ///< levels are the source's triangles or fitted to them, not samples
  Vec3d translation{0, 0, 0};  ///< what takes what stands still to the scene, on its nodes; said where it isn't 0
  Appearance appearance = plain_appearance();  ///< of the source: its factors hold where there is no map
  std::vector<ConstantMap> constants = {};     ///< what is no map because it is the same everywhere
};

/// Writes the parts as one GLB: the scene shows the finest level of each, in all of its places, with the coarser ones
/// as alternatives (`AssetNodeWriter`). \param rig  what moves the parts, which then are in spaces of their own; or an
/// empty one \throws Error(kUsage) where the file can't be written
/// \param looks  each class of looks is a primitive of its own, with a material of its own
/// \param options  how levels are told apart, and the numbers of vertices
/// \return [level in the file] its vertices: of a part that has fewer levels, those of its last one
std::vector<std::int64_t> write_asset(const std::filesystem::path& path, const std::vector<AssetPart>& parts,
                                      const std::vector<MaterialMap>& maps, const AssetOrigin& origin, const Rig& rig,
                                      const Looks& looks, const ExportOptions& options = {});

/// The smallest share of the screen that the box of the part covers at which each level, finest first, should still be
/// shown: where the next coarser one is off by fewer than some pixels, it does as well; or, where nobody knows, has
/// triangles of as few. The last one is never hidden: 0.
std::vector<double> screen_coverages(std::span<const PartLevel> levels);

}  // namespace lozenge
