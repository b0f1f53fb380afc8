// The file of a geometry image: a tiled, multi-part EXR, and the same facts as JSON beside it (docs/format.md).
#pragma once

#include <filesystem>
#include <string>

#include "formats/patches/geometry_image.h"

namespace lozenge {

/// The format's version, in both files and in those of patch sets; version 1 is read, too.
inline constexpr int kGeometryImageVersion = 2;

/// Writes `exr` and the JSON beside it (NAME.gim.json for NAME.gim.exr), each whole or not at all.
/// \throws Error(kUnusableInput) where a file can't be written
void write_geometry_image(const std::filesystem::path& exr, const GeometryImage& image);

/// The same bits that were written; the JSON isn't needed. Everything is checked: sizes, the layout, reciprocal
/// adjacency that agrees with the places, finite samples inside the bounds, shared borders and levels that repeat the
/// finest one's samples bit for bit. \throws Error(kUnusableInput) where the file can't be read, or isn't a geometry
/// image, or contradicts itself
GeometryImage read_geometry_image(const std::filesystem::path& exr);

/// The text of the JSON file.
std::string geometry_image_json(const GeometryImage& image);

/// NAME.json beside NAME.exr.
std::filesystem::path json_beside(const std::filesystem::path& exr);

}  // namespace lozenge
