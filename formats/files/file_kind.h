// Tells which of Lozenge's files a file is, by what is in it, or that it is an asset that can be imported. Its name
// only counts where its content can't tell (input_format.h).
#pragma once

#include <filesystem>
#include <string_view>

namespace lozenge {

enum class FileKind {
  kSourceMesh,         ///< GLB: one surface; any glTF binary that is nothing else below
  kParameterization,   ///< GLB with domain attributes
  kAsset,              ///< GLB that `export` wrote
  kPatchSet,           ///< EXR
  kGeometryImage,      ///< EXR
  kGeometryImageJson,  ///< the JSON beside a geometry image
  kMapPng,             ///< a baked map
  kMapExr,             ///< a baked map
  kMapKtx2,            ///< a baked map with its mips
  kForeignMesh,        ///< a mesh in another format than glTF: PLY, OBJ, STL, OFF (input_format.h)
  kPicture,            ///< PNG that `render` drew, or the contact sheet of `build`
};

/// "parameterization", "geometry image", ...
std::string_view name_of(FileKind kind);

/// \throws Error(kUnusableInput) where the file cannot be read or is none of these
FileKind recognise_file(const std::filesystem::path& path);

}  // namespace lozenge
