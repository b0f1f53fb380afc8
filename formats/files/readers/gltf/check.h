// Whether a glTF document holds together: what the specification demands, and tinygltf takes on trust.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lozenge {

/// Whether an asset may use it without the shape being another than what is read: extensions of materials, textures and
/// lights don't touch the shape, those of meshes that are named here are read.
bool knows_gltf_extension(const std::string& extension);

/// The version is 2, and the extensions that the asset requires are among those that change nothing of the shape, or
/// that we know.
/// \throws Error(kUnsupported) otherwise, naming them; Error(kUnusableInput) where it's no glTF at all
void check_gltf_needs(const nlohmann::json& document, const std::string& name);

/// Types, ranges and indices of all that makes a surface: buffer views lie inside their buffers, accessors inside their
/// views, every index names something, nodes form trees. \param buffer_sizes  [buffer] bytes that are there \throws
/// Error(kUnusableInput) naming the place; Error(kLimit) for an accessor without data of an absurd count
void check_gltf_structure(const nlohmann::json& document, const std::vector<std::uint64_t>& buffer_sizes,
                          const std::string& name);

}  // namespace lozenge
