// Texture coordinates alone: an asset gets a set of them over an atlas of patches, and stays what it is otherwise.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "stages/import/import.h"
#include "stages/parameterize/parameterize.h"

namespace lozenge {

struct UnwrapOptions {
  ImportOptions import;
  ParameterizeOptions parameterize;
  int uv_set = 0;  ///< TEXCOORD number: one that is there is replaced, the others stay
  /// Side of the square atlas, in texels; 0: 2048, or as much more as its patches need.
  std::int32_t map_size = 0;
  std::int32_t gutter = 2;  ///< texels around each patch that belong to it
  /// Texels to a unit of length on the surface, where the mesh is placed largest: decides the atlas's side; 0: not.
  double texels_per_unit = 0;
  bool pack_each = false;  ///< an atlas for each mesh; else one for all
};

/// One atlas that was made.
struct UnwrapAtlas {
  std::string name;  ///< of the mesh, or of the asset
  std::int32_t map_size = 0;
  std::int64_t patches = 0;
  std::int64_t charts = 0;  ///< patches in rows, that have no seams between them
  double inner_share = 0;   ///< of the atlas's texels, that lie in patches; gutters don't
  double l2_stretch = 1;    ///< of the atlas's squares; 1 would keep all lengths
  double texels_per_unit = 0;
};

struct UnwrapResult {
  std::int64_t meshes = 0;  ///< that were unwrapped
  std::int64_t triangles_before = 0;
  std::int64_t triangles = 0;
  /// Of those, triangles that repair left out of the surface: their texture coordinates are one point.
  std::int64_t left_out = 0;
  std::vector<UnwrapAtlas> atlases;
  std::vector<std::string> notes;
};

/// Writes `input` as GLB to `output`, each mesh that a node places with new texture coordinates: its triangles are cut
/// along the borders of patches, all attributes and morph targets interpolated there. Each is unwrapped once, in its
/// own space, however often it is placed; the largest placement says how many texels it gets. Everything else of a glTF
/// asset stays as it is: materials, nodes, skins, animations, extras.
/// \throws Error as `import_asset` and `parameterize` do; Error(kLimit) where the atlas is too small
UnwrapResult unwrap(const std::filesystem::path& input, const std::filesystem::path& output,
                    const UnwrapOptions& options, const Progress& progress = {});

std::string unwrap_json(const UnwrapResult& result);
std::vector<std::string> unwrap_lines(const UnwrapResult& result);

}  // namespace lozenge
