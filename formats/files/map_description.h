// What a map is beyond its pixels, as one line of text that travels in its file: "lozenge tangent-normal columns=16
// rows=15 tile=128 gutter=4 shrink=1 level=0 tiles0=225 ...".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/patches/baked_maps.h"

namespace lozenge {

/// \param normal_y  where y of tangent-space normals points in the file
std::string map_description(const BakedMap& map, NormalY normal_y = NormalY::kUp);

/// Where it says that y points.
NormalY described_normal_y(std::string_view text);

/// The map that a description tells of, still without texels and with all channels of its kind; nothing where it tells
/// of none, or of tiles that can't lie in a picture of this size.
std::optional<BakedMap> described_map(std::string_view text, std::int32_t width, std::int32_t height);

}  // namespace lozenge
