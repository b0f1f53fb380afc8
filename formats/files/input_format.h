// The formats that an asset may come in, told apart by what is in a file.
#pragma once

#include <filesystem>
#include <string_view>

#include "formats/files/readers/input_asset.h"
#include "formats/files/readers/input_limits.h"
#include "formats/files/readers/input_start.h"

namespace lozenge {

struct InputFormat {
  std::string_view name;     ///< "PLY"
  std::string_view endings;  ///< of files, with dots, a blank after each: ".glb .gltf "
  Likeness (*likeness)(const InputStart& start);
  InputAsset (*read)(const std::filesystem::path& path, const InputLimits& limits);
};

/// The format of a file: the one that its content is sure to be, else the one that its name's ending says, if the
/// content doesn't speak against it; null where that is none.
const InputFormat* find_input_format(const std::filesystem::path& path, const InputStart& start);

/// "glTF, PLY, OBJ, STL or OFF".
std::string input_format_names();

/// Opens an asset of any of the formats.
/// \throws Error(kUnusableInput) where the file is missing, broken, or of no format that is read; Error(kUnsupported)
///         where it needs what we don't do, and Error(kLimit) where it is larger than `limits`
InputAsset open_input(const std::filesystem::path& path, const InputLimits& limits = {});

}  // namespace lozenge
