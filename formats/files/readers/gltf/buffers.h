// The bytes of a glTF asset's buffers: the BIN chunk, data URIs, and files beside the asset.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "formats/base/memory_budget.h"
#include "formats/files/readers/gltf/container.h"
#include "formats/files/readers/gltf/mend_structure.h"
#include "formats/files/readers/gltf/range.h"

namespace lozenge {

/// [buffer] its bytes, at most `byteLength` of them; none of a buffer that only stands in for compressed ones
/// (meshopt.h). The BIN chunk is moved out of `container`. A buffer of which bytes are missing, or whose URI is none
/// of: data URI in base64, relative path that stays in the asset's folder, is among the defects. \throws Error(kLimit)
/// where they are too many
GltfBytes load_gltf_buffers(const nlohmann::json& document, GltfContainer& container,
                            const std::filesystem::path& folder, const std::string& name, MemoryBudget& budget,
                            GltfDefects& defects, Deviations& deviations);

/// The path below `folder` that a relative URI names.
/// \param what  how messages call it: "statue.gltf: buffer 0"
/// \throws Error(kUnusableInput) where the URI has a scheme, is absolute or climbs out of the folder, be it through a
///         symbolic link
std::filesystem::path resolve_gltf_uri(const std::string& uri, const std::filesystem::path& folder,
                                       const std::string& what);

/// The bytes of a data URI; none where it isn't in base64, or is longer than 2 GB.
std::vector<unsigned char> decode_data_uri(const std::string& uri);

}  // namespace lozenge
