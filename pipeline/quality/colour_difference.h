// How different two colours look: CIEDE2000.
//
// After G. Sharma, W. Wu, E. N. Dalal: The CIEDE2000 color-difference formula: implementation notes, supplementary test
// data, and mathematical observations. Color Research and Application 30(1), 2005, equations 2 to 22.
#pragma once

#include "formats/base/vector.h"

namespace lozenge {

/// L*, a*, b* of linear sRGB colours from 0 to 1, for the white D65.
Vec3d lab_of_linear(const Vec3d& colour);

/// Between two colours as L*, a*, b*: 1 is just to be seen side by side, 100 is black against white.
double ciede2000(const Vec3d& first, const Vec3d& second);

}  // namespace lozenge
