// Arrays of patches as pictures of 16 bits, for programs that read no others.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/files/named_array.h"

namespace lozenge {

/// Writes `json`, and beside NAME.json a NAME.ARRAY.png of each array that has ranges; other arrays are left out.
/// A picture has a tile for each patch, row by row from the top left. Numbers are spaced evenly between the least and
/// the largest of their channel, which the JSON tells: number = least + (largest - least) * integer / 65535. Integers
/// of one channel are one more than they are (so that -1 is 0) and lie in two: 65536 * red + green.
/// The JSON is one object: `geometry_image`, the text of that name, which is JSON itself, and `pictures`, a list of
/// {`array`, `file`, `shape`, `columns`, `ranges` or `integers`}.
/// \throws Error(kUsage) or Error(kSystem) where a file can't be written
void write_tile_pictures(const std::filesystem::path& json, const std::string& geometry_image,
                         const std::vector<NamedArray>& arrays);

}  // namespace lozenge
