// The materials of a glTF asset.
#pragma once

#include <string>
#include <vector>

#include "formats/base/memory_budget.h"
#include "formats/files/readers/deviations.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/material.h"

namespace lozenge {

struct GltfMaterials {
  std::vector<Material> looks;  ///< [material]
  std::vector<EncodedImage> images;
};

/// Factors out of range are brought into it. A texture whose image can't be read is none.
/// \param used   [material] whether anything has it; the others' images aren't read
/// \param deviations  gets pictures that can't be read \param notes  sentences about what else isn't taken
/// \throws Error(kLimit) where images take more memory than the budget has
GltfMaterials read_materials(const GltfFile& file, const std::vector<bool>& used, MemoryBudget& budget,
                             Deviations& deviations, std::vector<std::string>& notes);

}  // namespace lozenge
