// KHR_draco_mesh_compression: primitives whose triangles and attributes are compressed by Draco.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "formats/base/memory_budget.h"
#include "formats/files/readers/gltf/mend_structure.h"
#include "formats/files/readers/gltf/range.h"

namespace lozenge {

/// Decodes every compressed primitive into a buffer of its own, appended to `buffers`, and gives the primitive
/// accessors of that, so that nobody else has to know of the compression. A primitive whose bytes are damaged, or whose
/// counts are not those of its accessors, is among the defects.
/// \param most_triangles  of all compressed primitives together
/// \throws Error(kUnsupported) where Draco's format is older than what glTF allows; Error(kLimit) where there are too
///         many triangles or bytes
void decode_draco_primitives(nlohmann::json& document, GltfBytes& buffers, const std::string& name,
                             MemoryBudget& budget, std::uint64_t most_triangles, GltfDefects& defects);

}  // namespace lozenge
