#include "formats/patches/shrunk_atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

/// Calls f(atlas, shrunk, shrink, place) for every texel of maps of some resolutions over closed and open surfaces.
template <typename F>
void for_each_texel(const F& f) {
  for (const GeometryImage& image :
       {fixtures::sphere_image(fixtures::icosahedron(), 3), fixtures::sphere_image(fixtures::tetrahedron(), 2),
        fixtures::open_image(fixtures::hemisphere(12), 3)}) {
    for (const std::int32_t shrink : {2, 4, 8}) {
      const Atlas atlas(image, make_map_layout(image.layout, 256, 4));
      const ShrunkAtlas shrunk(atlas, shrink);
      for (std::int32_t y = 0; y < atlas.layout().height / shrink; ++y) {
        for (std::int32_t x = 0; x < atlas.layout().width / shrink; ++x) {
          const AtlasPlace place = shrunk.place_of(x, y);
          if (place.patch >= 0) f(atlas, shrunk, shrink, place);
        }
      }
    }
  }
}

TEST(ShrunkAtlas, TexelsAreTheirPatchsOwnWhereItHasTheirMiddles) {
  for_each_texel([](const Atlas& atlas, const ShrunkAtlas& shrunk, std::int32_t, const AtlasPlace& place) {
    EXPECT_EQ(shrunk.is_own(place), atlas.within_patch(place) && atlas.exists(place));
  });
}

TEST(ShrunkAtlas, AllOtherTexelsShowOneOwnTexelOfTheOtherPatchOrWhatLiesBetweenSome) {
  for_each_texel([](const Atlas& atlas, const ShrunkAtlas& shrunk, std::int32_t shrink, const AtlasPlace& place) {
    if (shrunk.is_own(place)) return;
    const TexelMix mix = shrunk.shown_at(place);
    const AtlasPlace owner = atlas.inside(place);
    EXPECT_EQ(mix.patch, owner.patch);
    EXPECT_NEAR(std::accumulate(mix.weights.begin(), mix.weights.end(), 0.0), 1, 1e-12);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_GE(mix.weights[k], 0);
      EXPECT_TRUE(shrunk.is_own(mix.places[k]));
      const MapTile& tile = atlas.tile(mix.patch);
      const auto width = static_cast<std::size_t>(atlas.layout().width / shrink);
      EXPECT_EQ(shrunk.place_of(static_cast<std::int32_t>(mix.texels[k] % width),
                                static_cast<std::int32_t>(mix.texels[k] / width)),
                mix.places[k]);
      // No farther than the next texel: in the mirrored half of a half patch as far from the diagonal.
      const double away = std::max(std::abs(mix.places[k].x - owner.x), std::abs(mix.places[k].y - owner.y));
      EXPECT_LT(away, 2 * shrink + tile.gutter);
    }
  });
}

TEST(ShrunkAtlas, AcrossABorderLooksAreExactWhereTheSurfaceIsLinear) {
  // Inside of a patch u + 2 v is linear; a look-up at a gutter texel's place gives it where no middle is missing.
  for_each_texel([](const Atlas& atlas, const ShrunkAtlas& shrunk, std::int32_t shrink, const AtlasPlace& place) {
    if (shrunk.is_own(place)) return;
    const AtlasPlace owner = atlas.inside(place);
    const double last = atlas.last(owner.patch);
    const bool is_deep = std::min({owner.x, owner.y, last - owner.x, last - owner.y}) >= shrink;
    if (!is_deep || owner.y - owner.x < 2 * shrink) return;
    const TexelMix mix = shrunk.shown_at(place);
    double seen = 0;
    for (std::size_t k = 0; k < 4; ++k) seen += mix.weights[k] * (mix.places[k].x + 2 * mix.places[k].y);
    EXPECT_NEAR(seen, owner.x + 2 * owner.y, 1e-9);
  });
}

}  // namespace
}  // namespace lozenge
