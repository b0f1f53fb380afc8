#include "formats/files/readers/gltf/material_extensions.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "formats/files/readers/gltf/values.h"
#include "formats/surface/extension_textures.h"

namespace lozenge {

namespace {

using tinygltf::Value;

constexpr double kNoEnd = std::numeric_limits<float>::max();

/// A number, or three of them, that an extension may have.
struct Property {
  std::string_view extension;
  std::string_view name;
  double least = 0;
  double most = 1;
  std::size_t numbers = 1;
};

constexpr std::array kProperties{
    Property{"KHR_materials_anisotropy", "anisotropyStrength"},
    Property{"KHR_materials_clearcoat", "clearcoatFactor"},
    Property{"KHR_materials_clearcoat", "clearcoatRoughnessFactor"},
    Property{"KHR_materials_dispersion", "dispersion", 0, kNoEnd},
    Property{"KHR_materials_ior", "ior", 1, kNoEnd},
    Property{"KHR_materials_iridescence", "iridescenceFactor"},
    Property{"KHR_materials_iridescence", "iridescenceIor", 1, kNoEnd},
    Property{"KHR_materials_iridescence", "iridescenceThicknessMinimum", 0, kNoEnd},
    Property{"KHR_materials_iridescence", "iridescenceThicknessMaximum", 0, kNoEnd},
    Property{"KHR_materials_sheen", "sheenColorFactor", 0, 1, 3},
    Property{"KHR_materials_sheen", "sheenRoughnessFactor"},
    Property{"KHR_materials_specular", "specularFactor"},
    Property{"KHR_materials_specular", "specularColorFactor", 0, kNoEnd, 3},
    Property{"KHR_materials_transmission", "transmissionFactor"},
    Property{"KHR_materials_volume", "thicknessFactor", 0, kNoEnd},
    Property{"KHR_materials_volume", "attenuationDistance", 1e-9, kNoEnd},
    Property{"KHR_materials_volume", "attenuationColor", 0, 1, 3},
};

/// Says all by being there.
constexpr std::string_view kUnlit = "KHR_materials_unlit";

bool is_known(std::string_view extension) {
  return extension == kUnlit || std::any_of(kProperties.begin(), kProperties.end(),
                                            [&](const Property& property) { return property.extension == extension; });
}

/// The value in its range; null where it is none.
Value fitted(const Value& value, const Property& property) {
  const auto fit = [&](const Value& number) {
    return Value(std::clamp(number.GetNumberAsDouble(), property.least, property.most));
  };
  const auto is_sound = [](const Value& number) {
    return number.IsNumber() && std::isfinite(number.GetNumberAsDouble());
  };
  if (property.numbers == 1) return is_sound(value) ? fit(value) : Value();
  if (!value.IsArray() || value.ArrayLen() != property.numbers) return {};
  Value::Array list;
  for (const Value& number : value.Get<Value::Array>()) {
    if (!is_sound(number)) return {};
    list.push_back(fit(number));
  }
  return Value(std::move(list));
}

/// Whether the texture, of this name, of the extension is one that is read.
bool is_read(std::string_view extension, std::string_view texture) {
  return std::any_of(kExtensionTextures.begin(), kExtensionTextures.end(),
                     [&](const ExtensionTexture& row) { return row.extension == extension && row.texture == texture; });
}

}  // namespace

std::string material_extensions(const tinygltf::Material& material, std::vector<std::string>& left_out) {
  Value::Object kept;
  for (const auto& [name, value] : material.extensions) {
    if (!is_known(name)) {
      left_out.push_back(name);
      continue;
    }
    Value::Object properties;
    for (const Property& property : kProperties) {
      const std::string key(property.name);
      if (name != property.extension || !value.IsObject() || !value.Has(key)) continue;
      Value number = fitted(value.Get(key), property);
      if (number.Type() != tinygltf::NULL_TYPE) properties[key] = std::move(number);
    }
    bool has_texture = false;
    for (const std::string& key : value.Keys()) {
      if (is_read(name, key)) has_texture = true;
      else if (key.ends_with("Texture")) left_out.push_back(name + "'s " + key);
    }
    if (name == kUnlit || has_texture || !properties.empty()) kept[name] = Value(std::move(properties));
  }
  return kept.empty() ? std::string() : text_of(Value(std::move(kept)));
}

}  // namespace lozenge
