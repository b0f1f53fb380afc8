#include "formats/files/material_slots.h"

#include <cassert>

namespace lozenge {

int& texture_in(tinygltf::Material& material, MaterialSlot slot) {
  switch (slot) {
    case MaterialSlot::kBaseColour:
      return material.pbrMetallicRoughness.baseColorTexture.index;
    case MaterialSlot::kNormal:
      return material.normalTexture.index;
    case MaterialSlot::kMetallicRoughness:
      return material.pbrMetallicRoughness.metallicRoughnessTexture.index;
    case MaterialSlot::kEmissive:
      return material.emissiveTexture.index;
    default:
      assert(slot == MaterialSlot::kOcclusion);
      return material.occlusionTexture.index;
  }
}

int texture_in(const tinygltf::Material& material, MaterialSlot slot) {
  return texture_in(const_cast<tinygltf::Material&>(material), slot);
}

}  // namespace lozenge
