#include "formats/surface/look_classes.h"

#include <algorithm>
#include <tuple>

#include "formats/surface/appearance.h"

namespace lozenge {

std::int32_t code_of(const LookClass& look) {
  return 2 * static_cast<std::int32_t>(look.alpha_mode) + (look.double_sided ? 1 : 0);
}

LookClass class_of_code(std::int32_t code) { return {static_cast<AlphaMode>(code / 2), code % 2 != 0, {}}; }

LookClasses look_classes(const SourceMesh& mesh) {
  LookClasses looks;
  if (mesh.materials.empty()) {
    looks.classes.emplace_back();
    return looks;
  }
  const std::vector<bool> used = used_materials(mesh);
  std::vector<LookClass> of_material(used.size());
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (!mesh.material_looks.empty()) {
      of_material[m].alpha_mode = mesh.material_looks[m].alpha_mode;
      of_material[m].extensions = mesh.material_looks[m].extensions;
    }
    of_material[m].double_sided = !mesh.double_sided.empty() && mesh.double_sided[m];
    if (used[m]) looks.classes.push_back(of_material[m]);
  }
  const auto rank = [](const LookClass& look) { return std::tuple(code_of(look), look.extensions); };
  std::sort(looks.classes.begin(), looks.classes.end(),
            [&](const LookClass& a, const LookClass& b) { return rank(a) < rank(b); });
  looks.classes.erase(std::unique(looks.classes.begin(), looks.classes.end()), looks.classes.end());
  for (std::size_t m = 0; m < used.size(); ++m) {
    const auto at = std::find(looks.classes.begin(), looks.classes.end(), of_material[m]);
    looks.of_material.push_back(used[m] ? static_cast<std::int32_t>(at - looks.classes.begin()) : 0);
  }
  return looks;
}

}  // namespace lozenge
