// What the outputs of a build are called.
#pragma once

#include <filesystem>
#include <string>

namespace lozenge {

/// NAME of NAME.glb and all others: the one that was asked for, or where that is empty, the input's without its
/// extension. \throws Error(kUsage) where no file can have that name
std::string output_name(const std::filesystem::path& input, const std::string& asked);

/// \throws Error(kUsage) where `output` is the input itself
void refuse_to_replace_input(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace lozenge
