#include "formats/surface/material.h"

#include <cmath>

namespace lozenge {

Vec2d step_in_texture(const TextureUse& texture, const Vec2d& step) {
  // KHR_texture_transform: v runs down, so that a turn counter-clockwise has its sines this way around.
  const double x = step.x * texture.scale.x;
  const double y = step.y * texture.scale.y;
  const double c = std::cos(texture.rotation);
  const double s = std::sin(texture.rotation);
  return {c * x + s * y, c * y - s * x};
}

Vec2d place_in_texture(const TextureUse& texture, const Vec2d& coordinate) {
  return step_in_texture(texture, coordinate) + texture.offset;
}

}  // namespace lozenge
