// What the importer left out or changed, as sentences for a log.
#pragma once

#include <string>
#include <vector>

#include "stages/import/import.h"

namespace lozenge {

/// Empty where the asset was taken as it is.
std::vector<std::string> import_notes(const ImportReport& report);

}  // namespace lozenge
