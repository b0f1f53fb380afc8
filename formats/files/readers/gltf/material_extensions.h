// The extensions of a glTF material that no map of ours holds: what they say without textures.
#pragma once

#include <string>
#include <vector>

namespace tinygltf {
struct Material;
}

namespace lozenge {

/// Material::extensions of a material: those that are known, by their names in order, numbers in the range that they
/// make sense in, textures left out.
/// \param left_out  gets the names of textures that are left out, and of extensions that aren't known
std::string material_extensions(const tinygltf::Material& material, std::vector<std::string>& left_out);

}  // namespace lozenge
