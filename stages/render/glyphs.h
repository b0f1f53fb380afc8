// The strokes of the small typeface.
#pragma once

#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// In units of a seventh of a capital's height, y up from the baseline.
struct Glyph {
  std::vector<std::vector<Vec2d>> strokes;
  double width = 0;  ///< of the drawing; letters stand kLetterGap apart
};

inline constexpr double kCapitalHeight = 7;
inline constexpr double kLetterGap = 1.6;

/// ASCII; '?' for everything else.
const Glyph& glyph_of(char c);

}  // namespace lozenge
