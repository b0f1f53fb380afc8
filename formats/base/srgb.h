// The curve between light and the numbers that pictures hold (sRGB, IEC 61966-2-1).
#pragma once

namespace lozenge {

/// Both from 0 to 1.
double linear_of_srgb(double encoded);
double srgb_of_linear(double light);

}  // namespace lozenge
