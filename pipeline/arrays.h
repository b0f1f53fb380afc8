// The files of a geometry image as data (docs/data.md).
#pragma once

#include <cstdint>
#include <filesystem>

#include "formats/base/progress.h"
#include "stages/export/export.h"

namespace lozenge {

enum class ArrayFormat : std::uint8_t {
  kNpz,    ///< one file of NumPy's arrays
  kPng16,  ///< a JSON, and pictures beside it
};

/// Writes `path` (NAME.npz, or NAME.json with the pictures NAME.ARRAY.png) in the place of what was there; all files
/// appear together, or none.
/// \param source  where samples are to be told on it: it is sampled again for that; null: they aren't
/// \throws Error as `patch_arrays`, and Error(kUsage) where the name has another ending
void write_arrays(const std::filesystem::path& path, ArrayFormat format, const GeometryImage& image,
                  const BakedMaps& maps, const SourceSurface* source = nullptr, const Progress& progress = {});

}  // namespace lozenge
