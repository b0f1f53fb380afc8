#include "pipeline/atlas_room.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/patches/map_layout.h"

namespace lozenge {

std::int32_t least_patches(const SurfaceFacts& surface, const ParameterizeOptions& options) {
  // A domain has no more triangles than the surface; of several parts, each has one at least, and what is asked for is
  // shared by scales that nobody knows yet.
  const std::int64_t asked = surface.components > 1 ? surface.components : options.min_domain_faces;
  const std::int64_t triangles =
      std::clamp<std::int64_t>(asked, std::int64_t{1}, std::max<std::int64_t>(surface.triangles, 1));
  return static_cast<std::int32_t>(triangles * 3 / 2);
}

void require_room_in_maps(const PatchLayout& patches, const BuildOptions& options, const std::string& file) {
  const std::int64_t enough = least_map_size(patches);
  const std::int64_t most = options.bake.size > 0 ? options.bake.size : kMostMapSize;
  if (most >= enough) return;
  throw Error(ExitCode::kLimit,
              fmt::format("{}: {} patches don't fit into maps of {} x {} texels; {}", file, patches.size(), most, most,
                          enough <= kMostMapSize
                              ? fmt::format("--map-size {} has room for them, or give fewer --domain-faces", enough)
                              : "give fewer --domain-faces"));
}

void require_room_in_maps(std::int32_t patches, const BuildOptions& options, const std::string& file) {
  PatchLayout all_alike;
  all_alike.places.resize(static_cast<std::size_t>(std::max(patches, 0)));
  require_room_in_maps(all_alike, options, file);
}

}  // namespace lozenge
