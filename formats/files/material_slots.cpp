#include "formats/files/material_slots.h"

#include <cassert>
#include <string>

namespace lozenge {

namespace {

using tinygltf::Value;

int& core_texture(tinygltf::Material& material, MaterialSlot slot) {
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

}  // namespace

int texture_in(const tinygltf::Material& material, MaterialSlot slot) {
  const ExtensionTexture* row = extension_texture(slot);
  if (row == nullptr) return core_texture(const_cast<tinygltf::Material&>(material), slot);
  const auto at = material.extensions.find(std::string(row->extension));
  if (at == material.extensions.end() || !at->second.IsObject()) return -1;
  const Value& info = at->second.Get(std::string(row->texture));
  if (!info.IsObject() || !info.Get("index").IsInt()) return -1;
  return info.Get("index").GetNumberAsInt();
}

bool has_slot(const tinygltf::Material& material, MaterialSlot slot) {
  const ExtensionTexture* row = extension_texture(slot);
  return row == nullptr || material.extensions.contains(std::string(row->extension));
}

void set_texture(tinygltf::Material& material, MaterialSlot slot, int texture) {
  const ExtensionTexture* row = extension_texture(slot);
  if (row == nullptr) {
    core_texture(material, slot) = texture;
    return;
  }
  Value& extension = material.extensions.at(std::string(row->extension));
  if (!extension.IsObject()) extension = Value(Value::Object());
  extension.Get<Value::Object>()[std::string(row->texture)] = Value(Value::Object{{"index", Value(texture)}});
}

}  // namespace lozenge
