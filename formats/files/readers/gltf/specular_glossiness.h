// KHR_materials_pbrSpecularGlossiness, which came before glTF's metal and roughness, told by those.
#pragma once

#include "formats/base/vector.h"

namespace lozenge {

/// Linear factors of the old model.
struct SpecularGlossiness {
  Vec4d diffuse{1, 1, 1, 1};
  Vec3d specular{1, 1, 1};
  double glossiness = 1;
};

struct MetallicRoughness {
  Vec4d base_colour{1, 1, 1, 1};
  double metallic = 1;
  double roughness = 1;
};

/// The metal and base colour that reflect as much, diffuse and specular, by their brightness.
MetallicRoughness metallic_roughness_of(const SpecularGlossiness& old);

}  // namespace lozenge
