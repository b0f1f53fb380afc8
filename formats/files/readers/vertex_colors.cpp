#include "formats/files/readers/vertex_colors.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

float linear_of(float encoded) {
  const double c = encoded;
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

}  // namespace

void make_linear(std::vector<float>& colors) {
  const bool of_bytes = std::any_of(colors.begin(), colors.end(), [](float c) { return c > 1; });
  const float scale = of_bytes ? 255.0F : 1.0F;
  for (std::size_t i = 0; i < colors.size(); i += 4) {
    if (colors[i + 3] == kNoColor) {
      std::fill_n(&colors[i], 4, 1.0F);
      continue;
    }
    if (colors[i + 3] == kOpaque) colors[i + 3] = scale;
    for (std::size_t c = 0; c < 4; ++c) colors[i + c] /= scale;
    for (std::size_t c = 0; c < 3; ++c) colors[i + c] = linear_of(colors[i + c]);
  }
}

}  // namespace lozenge
