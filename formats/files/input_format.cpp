#include "formats/files/input_format.h"

#include <array>

#include "formats/base/error.h"
#include "formats/files/gltf_asset.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/readers/obj.h"
#include "formats/files/readers/off.h"
#include "formats/files/readers/ply.h"
#include "formats/files/readers/stl.h"

namespace lozenge {

namespace {

/// Of several that are sure, the first one is right: those with a magic number come first, and STL, which only has a
/// length, comes last.
constexpr std::array kFormats{
    InputFormat{"glTF", ".glb .gltf ", likeness_to_gltf, read_gltf},
    InputFormat{"PLY", ".ply ", likeness_to_ply, read_ply},
    InputFormat{"OFF", ".off ", likeness_to_off, read_off},
    InputFormat{"OBJ", ".obj ", likeness_to_obj, read_obj},
    InputFormat{"STL", ".stl ", likeness_to_stl, read_stl},
};

bool has_ending(const InputFormat& format, const std::filesystem::path& path) {
  const std::string ending = in_lower_case(path.extension().string());
  return !ending.empty() && format.endings.find(ending + " ") != std::string_view::npos;
}

/// Formats that people will try.
std::string_view name_of_another(const InputStart& start) {
  if (start.bytes.starts_with("Kaydara FBX Binary") || start.bytes.starts_with("; FBX ")) return "FBX";
  if (start.bytes.starts_with("BLENDER")) return "Blender";
  if (start.bytes.starts_with("PXR-USDC") || start.bytes.starts_with("#usda")) return "USD";
  return {};
}

[[noreturn]] void refuse(const std::filesystem::path& path, const InputStart& start) {
  const std::string name = file_name_of(path);
  if (start.bytes.empty()) throw Error(ExitCode::kUnusableInput, name + ": is empty");
  if (const std::string_view other = name_of_another(start); !other.empty()) {
    throw Error(ExitCode::kUnsupported,
                name + ": is a file of " + std::string(other) + ", which isn't read; export it as glTF");
  }
  throw Error(ExitCode::kUnusableInput, name + ": is none of the formats that are read, which are " +
                                            input_format_names() + "; export it as one of them");
}

}  // namespace

const InputFormat* find_input_format(const std::filesystem::path& path, const InputStart& start) {
  if (start.bytes.empty()) return nullptr;
  for (const InputFormat& format : kFormats) {
    if (format.likeness(start) == Likeness::kSure) return &format;
  }
  for (const InputFormat& format : kFormats) {
    if (has_ending(format, path) && format.likeness(start) == Likeness::kIfNamedSo) return &format;
  }
  return nullptr;
}

std::string input_format_names() {
  std::string names;
  for (std::size_t f = 0; f < kFormats.size(); ++f) {
    if (f > 0) names += f + 1 < kFormats.size() ? ", " : " or ";
    names += kFormats[f].name;
  }
  return names;
}

InputAsset open_input(const std::filesystem::path& path, const InputLimits& limits) {
  const InputStart start = start_of(path);
  const InputFormat* format = find_input_format(path, start);
  if (format == nullptr) refuse(path, start);
  return format->read(path, limits);
}

}  // namespace lozenge
