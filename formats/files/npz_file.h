// NumPy's file of several arrays.
#pragma once

#include <filesystem>
#include <vector>

#include "formats/files/named_array.h"

namespace lozenge {

/// Writes `path`, a .npz, whole or not at all: a zip archive with NAME.npy for each array, in their order, which
/// numpy.load reads. Members are stored as they are, not deflated, and have no date: the same arrays give the same
/// bytes, whatever the version of zlib.
/// \throws Error(kUsage) or Error(kSystem) where that can't be done
void write_npz(const std::filesystem::path& path, const std::vector<NamedArray>& arrays);

}  // namespace lozenge
