// What an asset promises: levels of one surface, attributes of unit length, a material whose textures are there.
#pragma once

#include "formats/files/asset_file.h"
#include "stages/check/check_report.h"

namespace lozenge {

CheckReport check_asset(const Asset& asset);

}  // namespace lozenge
