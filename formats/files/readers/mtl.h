// The materials of a Wavefront OBJ: files of their own that it names, and the pictures that those name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/files/readers/input_limits.h"
#include "formats/surface/material.h"

namespace lozenge {

struct MtlMaterials {
  std::vector<Material> looks;  ///< [name asked for]; empty where no library could be read
  std::vector<EncodedImage> images;
  std::vector<std::string> notes;            ///< sentences about what isn't taken
  std::vector<std::string> broken_pictures;  ///< why each can't be read
  std::vector<std::filesystem::path> files;  ///< libraries and pictures, those that aren't there too
};

/// Of each material: Kd (as sRGB, which is what programs show of it), d or Tr, Ke, Ns, the roughness and metal of the
/// extension for physically based shading (Pr, Pm), and the textures map_Kd, map_Ke and norm, with their options -s, -o
/// and -clamp. What can't be read is named in a note, and the surface goes without it.
/// \param folder     of the OBJ: libraries and pictures lie there or below
/// \param libraries  files as `mtllib` names them; the last one that has a material counts
/// \param names      of materials
/// \throws Error(kLimit) where pictures take more memory than allowed
MtlMaterials read_mtl(const std::filesystem::path& folder, const std::vector<std::string>& libraries,
                      const std::vector<std::string>& names, const InputLimits& limits);

/// All files that an OBJ names. \throws Error(kUnusableInput) where it can't be read
std::vector<std::filesystem::path> files_named_by_obj(const std::filesystem::path& path);

}  // namespace lozenge
