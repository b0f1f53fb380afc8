// The content of a file, not its name, says what it is; its own reader takes it, and what the reader refuses is the
// failed line "readable". What was read goes through the checks of its kind.
#include "stages/check/check.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "formats/files/baked_maps_file.h"
#include "formats/files/file_kind.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/map_mips_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/picture_file.h"
#include "formats/files/source_mesh_file.h"
#include "stages/check/check_asset.h"
#include "stages/check/check_geometry_image.h"
#include "stages/check/check_gutters.h"
#include "stages/check/check_map.h"
#include "stages/check/check_parameterization.h"
#include "stages/check/check_patch_set.h"
#include "stages/check/check_source_mesh.h"

namespace lozenge {

namespace {

/// An EXR map may be of half floats, which hold a component of a unit vector to 11 bits.
constexpr int kHalfBits = 11;

/// Reads the file and checks what it holds; what the reader refuses becomes the failed line "readable".
template <typename Read, typename Check>
CheckReport read_and_check(FileKind kind, const Read& read, const Check& check) {
  CheckReport report;
  report.kind = name_of(kind);
  try {
    const auto content = read();
    report.add("readable", true, "");
    const CheckReport found = check(content);
    report.lines.insert(report.lines.end(), found.lines.begin(), found.lines.end());
    report.code = found.code;
  } catch (const Error& e) {
    report.add("readable", false, e.what());
    report.code = e.code();
  }
  return report;
}

/// The JSON says what the EXR says.
void check_json(const std::filesystem::path& exr, const GeometryImage& image, CheckReport& report) {
  const std::filesystem::path path = json_beside(exr);
  const std::string name = "the JSON beside it says the same";
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    report.add(name, false, fmt::format("there is no {}", path.filename().string()));
    return;
  }
  const auto found = nlohmann::json::parse(file, nullptr, false);
  const auto expected = nlohmann::json::parse(geometry_image_json(image));
  std::string differing;
  if (found.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      if (differing.empty() && (!found.contains(key) || found[key] != value)) differing = key;
    }
  }
  if (!found.is_object()) {
    report.add(name, false, fmt::format("{} is no JSON object", path.filename().string()));
  } else {
    report.add(name, differing.empty(),
               differing.empty() ? path.filename().string()
                                 : fmt::format("{} differs in \"{}\"", path.filename().string(), differing));
  }
}

CheckReport check_geometry_image_file(const std::filesystem::path& exr) {
  return read_and_check(
      FileKind::kGeometryImage, [&] { return read_geometry_image(exr); },
      [&](const GeometryImage& image) {
        CheckReport report = check_geometry_image(image);
        check_json(exr, image, report);
        return report;
      });
}

/// Bits a channel: the byte after width and height in a PNG's first chunk.
int bits_of_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(24);
  const int bits = file.get();
  return bits == 16 ? 16 : 8;
}

/// The geometry image of a map, where both stand side by side: NAME.gim.exr beside NAME.normal.png.
std::optional<GeometryImage> image_beside(const std::filesystem::path& map) {
  const std::filesystem::path exr = std::filesystem::path(map).replace_extension().replace_extension(".gim.exr");
  std::error_code error;
  if (!std::filesystem::is_regular_file(exr, error)) return std::nullopt;
  try {
    return read_geometry_image(exr);
  } catch (const Error&) {
    return std::nullopt;  // its own check says what is wrong
  }
}

CheckReport check_map_file(const std::filesystem::path& path, FileKind kind) {
  const int bits = kind == FileKind::kMapPng ? bits_of_png(path) : kHalfBits;
  return read_and_check(
      kind, [&] { return read_map(path); },
      [&](const BakedMap& map) {
        CheckReport report = check_map(map, bits);
        if (!report.passed()) return report;
        if (const auto image = image_beside(path)) check_gutters(map, bits, *image, report);
        return report;
      });
}

CheckReport check_mips_file(const std::filesystem::path& path) {
  return read_and_check(
      FileKind::kMapKtx2, [&] { return read_map_mips(path); },
      [&](const MapMips& maps) {
        CheckReport report = check_map(maps.map, maps.bits);
        if (!report.passed()) return report;
        if (const auto image = image_beside(path)) {
          check_gutters(maps.map, maps.bits, *image, report);
          if (report.passed()) check_mips(maps, *image, report);
        }
        return report;
      });
}

}  // namespace

CheckReport check_file(const std::filesystem::path& path) {
  const FileKind kind = recognise_file(path);
  switch (kind) {
    case FileKind::kSourceMesh:
      return read_and_check(
          kind, [&] { return read_source_mesh(path); }, check_source_mesh);
    case FileKind::kParameterization:
      return read_and_check(
          kind, [&] { return read_parameterization(path); },
          [](const auto& both) { return check_parameterization(both.first, both.second); });
    case FileKind::kAsset:
      return read_and_check(
          kind, [&] { return read_asset(path); }, check_asset);
    case FileKind::kPatchSet:
      return read_and_check(
          kind, [&] { return read_patch_set(path); }, check_patch_set);
    case FileKind::kGeometryImage:
      return check_geometry_image_file(path);
    case FileKind::kGeometryImageJson: {
      CheckReport report = check_geometry_image_file(std::filesystem::path(path).replace_extension(".exr"));
      report.kind = name_of(kind);
      return report;
    }
    case FileKind::kMapPng:
    case FileKind::kMapExr:
      return check_map_file(path, kind);
    case FileKind::kMapKtx2:
      return check_mips_file(path);
    case FileKind::kForeignMesh:
      throw Error(ExitCode::kUnusableInput,
                  path.filename().string() +
                      ": is a mesh of another program, of which Lozenge promised nothing; import "
                      "it, and check what comes of it");
    case FileKind::kPicture:
      return read_and_check(
          kind, [&] { return read_picture_facts(path); }, [](const PictureFacts&) { return CheckReport(); });
  }
  throw Error(ExitCode::kInternal, path.string() + ": is of a kind that nobody checks");
}

}  // namespace lozenge
