// Makes a glTF document hold together: afterwards all that the specification demands, and tinygltf takes on trust, is
// so. What can't be read goes, with what uses it.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "formats/files/readers/deviations.h"

namespace lozenge {

/// What was found to be broken before, by its number, and what is wrong with it.
struct GltfDefects {
  std::map<std::uint64_t, std::string> buffers;
  std::map<std::uint64_t, std::string> views;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::string> primitives;  ///< [mesh, primitive]
};

/// Buffer views then lie inside their buffers, accessors inside their views, every index names something, nodes form
/// trees. Primitives that are left out are erased; broken views and accessors stay as something small that nothing
/// uses, for numbers of others are not to change.
/// \param buffer_sizes  [buffer] bytes that are there
/// \throws Error(kLimit) for an accessor without data of an absurd count
void mend_gltf_structure(nlohmann::json& document, const std::vector<std::uint64_t>& buffer_sizes,
                         const GltfDefects& defects, const std::string& name, Deviations& deviations);

}  // namespace lozenge
