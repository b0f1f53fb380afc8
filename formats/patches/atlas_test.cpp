#include "formats/patches/atlas.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

GeometryImage image() { return fixtures::sphere_image(fixtures::icosahedron(), 1); }

MapLayout layout_of(const GeometryImage& image) { return make_map_layout(image.layout, 130, 3); }

TEST(Atlas, PlacesEveryTexelInOneTile) {
  const GeometryImage sphere = image();
  const MapLayout layout = layout_of(sphere);
  const Atlas atlas(sphere, layout);
  int placed = 0;
  for (std::int32_t y = 0; y < layout.height; ++y) {
    for (std::int32_t x = 0; x < layout.width; ++x) {
      const AtlasPlace place = atlas.place_at(x, y);
      if (place.patch < 0) continue;
      ++placed;
      EXPECT_EQ(atlas.texel_of(place), static_cast<std::size_t>(y) * layout.width + x);
      // The same as the texture coordinates say.
      const Vec2d texcoord = layout.texcoord(place.patch, place.x / atlas.last(0), place.y / atlas.last(0));
      EXPECT_NEAR(texcoord.x * layout.width, x + 0.5, 1e-9);
      EXPECT_NEAR(texcoord.y * layout.height, y + 0.5, 1e-9);
    }
  }
  EXPECT_EQ(placed, sphere.size() * layout.tile * layout.tile);
}

TEST(Atlas, LeavesPlacesInsideAsTheyAre) {
  const GeometryImage sphere = image();
  const Atlas atlas(sphere, layout_of(sphere));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(0, atlas.last(0));
  for (int i = 0; i < 1000; ++i) {
    const AtlasPlace place{i % sphere.size(), number(random), number(random)};
    EXPECT_EQ(atlas.inside(place), place);
    EXPECT_EQ(atlas.first_name(place), place);
  }
}

TEST(Atlas, CrossesABorderAndComesBack) {
  const GeometryImage sphere = image();
  const Atlas atlas(sphere, layout_of(sphere));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(0, atlas.last(0));
  for (int i = 0; i < 1000; ++i) {
    // Mirrored in the border that it was reached across, the neighbour's place lies where we started from.
    const double depth = 0.001 * number(random);
    const AtlasPlace beyond{i % sphere.size(), number(random), -depth};
    const AtlasPlace there = atlas.inside(beyond);
    EXPECT_NE(there.patch, beyond.patch);
    const PatchSide side = sphere.layout.adjacency[beyond.patch][0];
    AtlasPlace back = there;
    if (side.side == 0) back.y = -depth;
    if (side.side == 1) back.x = atlas.last(0) + depth;
    if (side.side == 2) back.y = atlas.last(0) + depth;
    if (side.side == 3) back.x = -depth;
    const AtlasPlace home = atlas.inside(back);
    EXPECT_EQ(home.patch, beyond.patch);
    EXPECT_NEAR(home.x, beyond.x, 1e-9);
    EXPECT_NEAR(home.y, depth, 1e-9);
  }
}

TEST(Atlas, FindsAPlaceBeyondEveryCornerAndFarOut) {
  const GeometryImage sphere = image();
  const Atlas atlas(sphere, layout_of(sphere));
  for (std::int32_t p = 0; p < sphere.size(); ++p) {
    for (double x = -atlas.last(0); x <= 2 * atlas.last(0); x += 0.5) {
      for (double y = -atlas.last(0); y <= 2 * atlas.last(0); y += 0.5) {
        const AtlasPlace place = atlas.inside({p, x, y});
        ASSERT_GE(place.patch, 0);
        ASSERT_LT(place.patch, sphere.size());
        ASSERT_GE(std::min(place.x, place.y), 0);
        ASSERT_LE(std::max(place.x, place.y), atlas.last(0));
      }
    }
  }
}

TEST(Atlas, GivesABorderTheSameFirstNameInAllItsPatches) {
  const GeometryImage sphere = image();
  const Atlas atlas(sphere, layout_of(sphere));
  for (std::int32_t p = 0; p < sphere.size(); ++p) {
    for (double k = 0; k <= atlas.last(0); ++k) {
      const AtlasPlace here{p, k, 0};
      const PatchSide side = sphere.layout.adjacency[p][0];
      const double other = atlas.last(0) - k;
      const AtlasPlace there = side.side == 0   ? AtlasPlace{side.patch, other, 0}
                               : side.side == 1 ? AtlasPlace{side.patch, atlas.last(0), other}
                               : side.side == 2 ? AtlasPlace{side.patch, k, atlas.last(0)}
                                                : AtlasPlace{side.patch, 0, k};
      EXPECT_EQ(atlas.first_name(here), atlas.first_name(there));
      EXPECT_LE(atlas.first_name(here).patch, std::min(p, side.patch));
    }
  }
}

TEST(Atlas, MirrorsAPatchInTheBoundaryOfTheSurface) {
  GeometryImage open = image();
  open.layout.places[4].right = {};
  for (const std::int32_t side : {0, 1}) {
    const PatchSide other = open.layout.adjacency[4][side];
    open.layout.adjacency[4][side] = {};
    open.layout.adjacency[other.patch][other.side] = {};
  }
  const Atlas atlas(open, layout_of(open));
  EXPECT_EQ(atlas.inside({4, 5, 2}), (AtlasPlace{4, 2, 5}));
  EXPECT_EQ(atlas.inside({4, 2, 5}), (AtlasPlace{4, 2, 5}));
  EXPECT_EQ(atlas.nearest_of_own_patch({4, 5, 2}), Vec2d(3.5, 3.5));
  for (double x = -3; x <= atlas.last(0) + 3; ++x) {
    for (double y = -3; y <= atlas.last(0) + 3; ++y) EXPECT_TRUE(atlas.exists(atlas.inside({4, x, y})));
  }
}

}  // namespace
}  // namespace lozenge
