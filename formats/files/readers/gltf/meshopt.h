// EXT_meshopt_compression: buffer views whose bytes are compressed by meshoptimizer.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "formats/base/memory_budget.h"
#include "formats/files/readers/gltf/mend_structure.h"
#include "formats/files/readers/gltf/range.h"

namespace lozenge {

class GltfObject;

/// Whether a buffer only stands in for those who can't read the compressed views: it may have no bytes at all.
bool is_meshopt_fallback(const GltfObject& buffer);

/// Decodes every compressed buffer view into a buffer of its own, appended to `buffers`, and points the view there, so
/// that nobody else has to know of the compression.
/// A view whose sizes, mode or filter contradict each other or whose bytes are damaged is among the defects.
/// \throws Error(kLimit) where the decoded bytes are too many
void decode_meshopt_views(nlohmann::json& document, GltfBytes& buffers, const std::string& name, MemoryBudget& budget,
                          GltfDefects& defects, Deviations& deviations);

}  // namespace lozenge
