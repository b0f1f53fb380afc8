// The file of a patch set: one EXR picture, whose tiles are the patches.
#pragma once

#include <filesystem>

#include "formats/patches/patch_set.h"

namespace lozenge {

/// Channels P.X P.Y P.Z, N.X N.Y N.Z, W.X W.Y W.Z (float: position, normal, weights in the source triangle) and
/// `source` (uint: the source triangle, 4294967295 for none). Patch p is tile p of a single column of tiles. \throws
/// Error(kUnusableInput) where the file can't be written
void write_patch_set(const std::filesystem::path& file, const PatchSet& patches);

/// The same bits that were written.
/// \throws Error(kUnusableInput) where the file can't be read, or is not a patch set, or contradicts itself
PatchSet read_patch_set(const std::filesystem::path& file);

}  // namespace lozenge
