#include "formats/surface/material.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lozenge {
namespace {

TEST(TextureUse, ScalesThenTurnsCounterClockwiseThenMovesAsKhrTextureTransformSays) {
  TextureUse use;
  use.offset = {0, 1};
  use.rotation = std::numbers::pi / 2;
  use.scale = {0.5, 0.5};
  // The extension's own example: the upper left corner of what is shown is the lower left one of the picture's quarter.
  const Vec2d origin = place_in_texture(use, {0, 0});
  EXPECT_NEAR(origin.x, 0, 1e-12);
  EXPECT_NEAR(origin.y, 1, 1e-12);
  const Vec2d right = place_in_texture(use, {1, 0});
  EXPECT_NEAR(right.x, 0, 1e-12);
  EXPECT_NEAR(right.y, 0.5, 1e-12);
  const Vec2d down = place_in_texture(use, {0, 1});
  EXPECT_NEAR(down.x, 0.5, 1e-12);
  EXPECT_NEAR(down.y, 1, 1e-12);
}

TEST(TextureUse, StepsAreDifferencesOfPlaces) {
  TextureUse use;
  use.offset = {0.3, -0.2};
  use.rotation = 0.7;
  use.scale = {3, -2};
  const Vec2d a(0.1, 0.9);
  const Vec2d b(0.4, 0.25);
  const Vec2d difference = place_in_texture(use, b) - place_in_texture(use, a);
  EXPECT_LT((difference - step_in_texture(use, b - a)).length(), 1e-12);
}

}  // namespace
}  // namespace lozenge
