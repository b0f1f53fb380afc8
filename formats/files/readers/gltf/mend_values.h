// Values of a glTF's JSON that are written otherwise than the specification says, but can mean one thing only.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "formats/files/readers/deviations.h"

namespace lozenge {

/// The document's lists become lists of objects. Whole numbers that are written as fractions become whole, what is null
/// or an index of -1 goes, and so does a name that is no text. Extras stay as they are. \pre the document's depth is
/// bounded (json.h)
void mend_gltf_values(nlohmann::json& document, const std::string& name, Deviations& deviations);

}  // namespace lozenge
