// The extensions of a glTF material: what they say in numbers.
#pragma once

#include <string>
#include <vector>

namespace tinygltf {
struct Material;
}

namespace lozenge {

/// Material::extensions of a material: those that are known, by their names in order, numbers in the range that they
/// make sense in, without what directions follow from.
/// \param left_out  gets the names of textures that aren't known (extension_textures.h), and of extensions
std::string material_extensions(const tinygltf::Material& material, std::vector<std::string>& left_out);

}  // namespace lozenge
