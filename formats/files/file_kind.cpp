// GLBs are told apart by their vertex attributes, EXRs by their channels.
#include "formats/files/file_kind.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <array>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>
#include <string>

#include "formats/base/error.h"
#include "formats/files/input_format.h"
#include "formats/files/ktx2_file.h"
#include "formats/files/picture_check.h"
#include "formats/files/picture_file.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/input_file.h"

namespace lozenge {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Error(ExitCode::kUnusableInput, fmt::format("{}: {}", path.filename().string(), what));
}

std::string first_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "it cannot be opened; check its name and your permission to read it");
  std::array<char, 16> bytes{};
  file.read(bytes.data(), bytes.size());
  return std::string(bytes.data(), static_cast<std::size_t>(file.gcount()));
}

FileKind kind_of_gltf(const std::filesystem::path& path) {
  Deviations deviations;
  const GltfFile file = open_gltf(path, {}, &deviations);
  bool has_tangents = false;
  for (const tinygltf::Mesh& mesh : file.model->meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      for (const auto& [name, accessor] : primitive.attributes) {
        if (name.starts_with("_DOMAIN_")) return FileKind::kParameterization;
        has_tangents = has_tangents || name == "TANGENT";
      }
    }
  }
  const bool ours = file.model->asset.generator.starts_with("lozenge");
  return ours && has_tangents ? FileKind::kAsset : FileKind::kSourceMesh;
}

/// A .gltf is JSON too; it has an asset, ours has an adjacency table.
FileKind kind_of_json(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (json.is_object() && json.contains("adjacency")) return FileKind::kGeometryImageJson;
  if (json.is_object() && json.contains("asset")) return kind_of_gltf(path);
  refuse(path, "it is JSON, but neither glTF nor the description of a geometry image");
}

FileKind kind_of_exr(const std::filesystem::path& path) {
  if (const auto defect = find_picture_defect(path)) refuse(path, *defect + "; make it again");
  try {
    const Imf::MultiPartInputFile file(path.c_str(), 1);
    const Imf::ChannelList& channels = file.header(0).channels();
    if (channels.findChannel("source")) return FileKind::kPatchSet;
    return channels.findChannel("P.X") ? FileKind::kGeometryImage : FileKind::kMapExr;
  } catch (const std::bad_alloc&) {
    throw;  // no fault of the file
  } catch (const std::exception& e) {
    refuse(path, fmt::format("it is a broken EXR ({}); make it again", e.what()));
  }
}

/// Whether a PNG has the description of a picture. Its chunks are read here, as the library that decodes images would
/// be loaded for nothing else by commands that only tell files apart.
bool is_picture(const std::filesystem::path& path) {
  if (find_picture_defect(path)) return false;
  std::ifstream file(path, std::ios::binary);
  file.seekg(8);
  const std::string wanted = std::string("Description") + '\0' + kPictureDescription;
  std::array<unsigned char, 8> head{};
  while (file.read(reinterpret_cast<char*>(head.data()), head.size())) {
    const std::uint32_t length = head[0] << 24U | head[1] << 16U | head[2] << 8U | head[3];
    const std::string type(head.begin() + 4, head.end());
    if (type == "IDAT") return false;
    if (type == "tEXt" && length == wanted.size()) {
      std::string text(length, ' ');
      if (file.read(text.data(), length) && text == wanted) return true;
      file.seekg(-static_cast<std::streamoff>(length), std::ios::cur);
    }
    file.seekg(static_cast<std::streamoff>(length) + 4, std::ios::cur);
  }
  return false;
}

}  // namespace

std::string_view name_of(FileKind kind) {
  switch (kind) {
    case FileKind::kSourceMesh:
      return "source mesh";
    case FileKind::kParameterization:
      return "parameterization";
    case FileKind::kAsset:
      return "asset";
    case FileKind::kPatchSet:
      return "patch set";
    case FileKind::kGeometryImage:
      return "geometry image";
    case FileKind::kGeometryImageJson:
      return "geometry image (JSON)";
    case FileKind::kMapPng:
      return "map (PNG)";
    case FileKind::kMapExr:
      return "map (EXR)";
    case FileKind::kMapKtx2:
      return "map with mips (KTX2)";
    case FileKind::kForeignMesh:
      return "mesh of another program";
    case FileKind::kPicture:
      return "picture";
  }
  return "unknown";
}

FileKind recognise_file(const std::filesystem::path& path) {
  const std::string start = first_bytes(path);
  if (start.starts_with("glTF")) return kind_of_gltf(path);
  if (start.starts_with("\x76\x2f\x31\x01")) return kind_of_exr(path);
  if (start.starts_with("\x89PNG\r\n\x1a\n")) {
    return is_picture(path) ? FileKind::kPicture : FileKind::kMapPng;
  }
  if (is_ktx2(start)) return FileKind::kMapKtx2;
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && start[first] == '{') return kind_of_json(path);
  const InputFormat* format = find_input_format(path, start_of(path));
  if (format != nullptr && format->name != "glTF") return FileKind::kForeignMesh;
  refuse(path, fmt::format("it is no EXR, PNG, KTX2 or JSON file, and no mesh in {}; give a file that Lozenge wrote, or an "
                           "asset",
                           input_format_names()));
}

}  // namespace lozenge
