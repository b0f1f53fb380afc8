#include "formats/surface/appearance.h"

#include <algorithm>
#include <optional>

#include "formats/surface/extension_textures.h"

namespace lozenge {

namespace {

Material plaster() {
  Material material;
  material.base_colour = {0.5, 0.5, 0.5, 1};
  material.metallic = 0;
  material.roughness = 0.8;
  return material;
}

bool has_colours(const SourceMesh& mesh) {
  const AttributeStream* colours = find_stream(mesh.corner_attributes, kColors);
  return colours != nullptr &&
         std::any_of(colours->values.begin(), colours->values.end(), [](float value) { return value != 1; });
}

bool is_opaque(const Material& m) { return m.alpha_mode == AlphaMode::kOpaque; }

/// Nothing where the material is no mask.
std::optional<double> cutoff_of(const Material& m) {
  return m.alpha_mode == AlphaMode::kMask ? std::optional(m.alpha_cutoff) : std::nullopt;
}

/// Of the materials that any triangle has.
std::vector<Material> used_looks(const SourceMesh& mesh) {
  std::vector<Material> used;
  if (mesh.material_looks.empty()) return used;
  const std::vector<bool> is_used = used_materials(mesh);
  for (std::size_t m = 0; m < is_used.size(); ++m) {
    if (is_used[m]) used.push_back(mesh.material_looks[m]);
  }
  return used;
}

/// Whether `differs(a, b)` of any two.
template <typename Differs>
bool any_differ(const std::vector<Material>& used, const Differs& differs) {
  return std::any_of(used.begin(), used.end(), [&](const Material& m) { return differs(m, used.front()); });
}

bool any_have(const std::vector<Material>& used, TextureRole role) {
  return std::any_of(used.begin(), used.end(), [&](const Material& m) { return m.texture(role).exists(); });
}

bool any_emission_differs(const std::vector<Material>& used) {
  const auto emission = [](const Material& m) { return m.emissive * m.emissive_strength; };
  const auto has_texture = [](const Material& m) {
    return strongest_emission(m) > 0 && m.texture(TextureRole::kEmissive).exists();
  };
  return std::any_of(used.begin(), used.end(), has_texture) ||
         any_differ(used, [&](const auto& a, const auto& b) { return emission(a) != emission(b); });
}

}  // namespace

std::vector<bool> used_materials(const SourceMesh& mesh) {
  std::vector<bool> used(mesh.material_names.size(), false);
  for (const std::int32_t material : mesh.materials) used[material] = true;
  return used;
}

bool has_made_look(const SourceMesh& mesh) {
  if (has_colours(mesh)) return true;
  const std::vector<Material> used = used_looks(mesh);
  const auto has_texture = [](const Material& m) {
    return std::any_of(m.textures.begin(), m.textures.end(), [](const auto& use) { return use.exists(); });
  };
  const auto is_coloured = [](const Material& m) {
    return m.base_colour.x != m.base_colour.y || m.base_colour.x != m.base_colour.z;
  };
  return std::any_of(used.begin(), used.end(), has_texture) || std::any_of(used.begin(), used.end(), is_coloured) ||
         any_emission_differs(used) || any_differ(used, [](const Material& a, const Material& b) {
           return a.base_colour != b.base_colour || a.metallic != b.metallic || a.roughness != b.roughness;
         });
}

double strongest_emission(const Material& material) {
  return std::max({material.emissive.x, material.emissive.y, material.emissive.z}) * material.emissive_strength;
}

Appearance plain_appearance() {
  Appearance appearance;
  appearance.factors = plaster();
  return appearance;
}

Appearance appearance_of(const SourceMesh& mesh) {
  Appearance appearance;
  const bool coloured = has_colours(mesh);
  appearance.has_base_colours = coloured;
  if (mesh.material_looks.empty()) {
    appearance.factors = plaster();
    if (coloured) appearance.factors.base_colour = {1, 1, 1, 1};
    return appearance;
  }
  const std::vector<Material> used = used_looks(mesh);
  if (used.empty()) return appearance;
  const Material& first = used.front();
  Material& factors = appearance.factors;
  factors = first;
  factors.textures = {};
  appearance.has_alpha = std::any_of(used.begin(), used.end(), [](const Material& m) { return !is_opaque(m); });
  if (!appearance.has_alpha) factors.base_colour.w = 1;
  appearance.has_base_colours =
      coloured || any_have(used, TextureRole::kBaseColour) || any_differ(used, [](const auto& a, const auto& b) {
        return a.base_colour != b.base_colour || cutoff_of(a) != cutoff_of(b);
      });
  // In a map of colours, alphas are scaled so that the cutoff is this (stages/bake/source_look.h).
  if (appearance.has_base_colours) factors.alpha_cutoff = 0.5;
  appearance.has_orm = any_have(used, TextureRole::kMetallicRoughness) || any_have(used, TextureRole::kOcclusion) ||
                       any_differ(used, [](const auto& a, const auto& b) {
                         return a.metallic != b.metallic || a.roughness != b.roughness;
                       });
  appearance.has_normals = any_have(used, TextureRole::kNormal);
  for (const ExtensionTexture& row : kExtensionTextures) {
    const bool by_tangents =
        row.role == TextureRole::kAnisotropy &&
        std::any_of(used.begin(), used.end(), [&](const Material& m) { return has_extension(m, row.extension); });
    appearance.has_extension_texture[static_cast<std::size_t>(row.role)] = by_tangents || any_have(used, row.role);
  }
  appearance.has_emissive = any_emission_differs(used);
  for (const Material& m : used) {
    appearance.emissive_strength = std::max(appearance.emissive_strength, strongest_emission(m));
  }
  return appearance;
}

}  // namespace lozenge
