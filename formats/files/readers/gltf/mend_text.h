// The text of a glTF's JSON, made such that a parser takes it: exporters cut names in the middle of a character, and
// pad with zeros.
#pragma once

#include <string>

#include "formats/files/readers/deviations.h"

namespace lozenge {

/// \param name  how messages call the file
void mend_gltf_text(std::string& text, const std::string& name, Deviations& deviations);

}  // namespace lozenge
