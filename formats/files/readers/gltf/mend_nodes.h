// The nodes and scenes of a glTF document, made such that every index names something and nodes form trees.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "formats/files/readers/deviations.h"

namespace lozenge {

class GltfObject;

/// \param has_primitives  [mesh]; nodes of others place nothing
/// \param require_accessor  throws Error(kUnusableInput) where what is under a key isn't an accessor that can be read
/// \pre nodes and scenes are lists of objects
void mend_gltf_nodes(nlohmann::json& document, const std::vector<bool>& has_primitives,
                     const std::function<void(const GltfObject&, const char*)>& require_accessor,
                     const std::string& name, Deviations& deviations);

}  // namespace lozenge
