// How surface is drawn as far as no texture can say it: whether it is seen through, and how; from which sides; and the
// extensions of its material that have no map. What differs in that is drawn apart, over the same atlas.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge {

struct LookClass {
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  bool double_sided = false;
  std::string extensions = {};  ///< Material::extensions

  bool operator==(const LookClass&) const = default;
};

/// Bit 0 is set where it is to be seen from both sides; the bits above are its alpha mode, 0 opaque.
std::int32_t code_of(const LookClass& look);
/// The class without extensions of a code. \pre it is one
LookClass class_of_code(std::int32_t code);

/// The classes of a surface, in the order in which they are to be drawn: opaque ones, masks, then what is blended.
struct LookClasses {
  std::vector<LookClass> classes;         ///< of materials that have triangles; at least one
  std::vector<std::int32_t> of_material;  ///< [material]; 0 of those without triangles; empty where there are none

  std::int32_t of(const SourceMesh& mesh, TriangleId t) const {
    return of_material.empty() ? 0 : of_material[mesh.materials[t]];
  }
};

LookClasses look_classes(const SourceMesh& mesh);

}  // namespace lozenge
