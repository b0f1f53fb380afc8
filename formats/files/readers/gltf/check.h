// Whether an asset needs only what we know.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lozenge {

/// Whether an asset may use it without the shape being another than what is read: extensions of materials, textures and
/// lights don't touch the shape, those of meshes that are named here are read.
bool knows_gltf_extension(const std::string& extension);

/// The version is 2, and the extensions that the asset requires are among those that change nothing of the shape, or
/// that we know.
/// \throws Error(kUnsupported) otherwise, naming them; Error(kUnusableInput) where it's no glTF at all
void check_gltf_needs(const nlohmann::json& document, const std::string& name);

}  // namespace lozenge
