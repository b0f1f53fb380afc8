// An asset made without the stages: for tests of whatever reads or writes one.
#pragma once

#include "formats/files/asset_file.h"

namespace lozenge::fixtures {

/// The sphere over the icosahedron with two levels of detail, tangent frames, and a flat normal map of 8 bits.
Asset sphere_asset();

}  // namespace lozenge::fixtures
