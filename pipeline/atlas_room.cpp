#include "pipeline/atlas_room.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/patches/baked_maps.h"

namespace lozenge {

std::int32_t least_patches(const SurfaceFacts& surface, const ParameterizeOptions& options) {
  // A domain has no more triangles than the surface; of several parts, each rounds its share of what was asked for.
  const std::int64_t asked = surface.components > 1 ? options.min_domain_faces / 2 : options.min_domain_faces;
  const std::int64_t triangles =
      std::clamp<std::int64_t>(asked, std::int64_t{1}, std::max<std::int64_t>(surface.triangles, 1));
  return static_cast<std::int32_t>(triangles * 3 / 2);
}

void require_room_in_maps(std::int32_t patches, const BuildOptions& options, const std::string& file) {
  const std::int32_t columns = atlas_columns(patches, options.pack);
  const std::int32_t rows = (patches + columns - 1) / columns;
  const std::int64_t enough = least_map_size(columns, rows, options.bake.gutter);
  if (options.bake.size >= enough) return;
  throw Error(ExitCode::kLimit,
              fmt::format("{}: {} patches with gutters of {} texels don't fit into maps of {} x {} texels; "
                          "--map-size {} has room for them, or give a smaller --gutter or fewer --domain-faces",
                          file, patches, options.bake.gutter, options.bake.size, options.bake.size, enough));
}

}  // namespace lozenge
