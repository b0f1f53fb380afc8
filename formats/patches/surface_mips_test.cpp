#include "formats/patches/surface_mips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/atlas.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

constexpr std::int32_t kSide = 512;

struct Case {
  std::string name;
  GeometryImage image;
};

std::vector<Case> spheres() {
  return {{"tetrahedron", fixtures::sphere_image(fixtures::tetrahedron(), 4)},
          {"octahedron", fixtures::sphere_image(fixtures::octahedron(), 4)},
          {"icosahedron", fixtures::sphere_image(fixtures::icosahedron(), 4)}};
}

std::vector<Case> cases() {
  std::vector<Case> all = spheres();
  for (const fixtures::OpenSurface& open : {fixtures::hemisphere(16), fixtures::fan(1, 12), fixtures::fan(4, 12)}) {
    all.push_back({open.name, fixtures::open_image(open, 4)});
  }
  return all;
}

/// The point of the finest level at a place inside of a patch.
Vec3d point_at(const GeometryImage& image, const Atlas& atlas, const AtlasPlace& place) {
  const Vec2d at = atlas.share_of(place) * static_cast<double>(image.layout.samples - 1);
  const auto i = std::min(static_cast<std::int32_t>(at.x), image.layout.samples - 2);
  const auto j = std::min(static_cast<std::int32_t>(at.y), image.layout.samples - 2);
  const double s = at.x - i;
  const double t = at.y - j;
  const auto sample = [&](std::int32_t x, std::int32_t y) {
    // Half patches have no samples below their diagonal.
    if (!image.layout.places[place.patch].right.exists() && x > y) std::swap(x, y);
    return Vec3d(image.position(0, place.patch, x, y));
  };
  return (sample(i, j) * (1 - s) + sample(i + 1, j) * s) * (1 - t) +
         (sample(i, j + 1) * (1 - s) + sample(i + 1, j + 1) * s) * t;
}

/// A map with true gutters, whose texels are what `value` says of a patch's place.
template <typename Value>
BakedMap filled_map(MapKind kind, const GeometryImage& image, const Value& value) {
  BakedMap map = neutral_map(kind, make_map_layout(image.layout, kSide, 4), 0);
  const Atlas atlas(image, map.layout);
  for (std::int32_t p = 0; p < image.size(); ++p) {
    const MapTile tile = map.layout.tile_of(p);
    for (std::int32_t y = -tile.gutter; y < tile.inner() + tile.gutter; ++y) {
      for (std::int32_t x = -tile.gutter; x < tile.inner() + tile.gutter; ++x) {
        const AtlasPlace place{p, static_cast<double>(x), static_cast<double>(y)};
        const auto texel = value(atlas, atlas.first_name(atlas.inside(place)));
        std::copy_n(texel.begin(), map.channels,
                    map.texels.begin() + static_cast<std::ptrdiff_t>(atlas.texel_of(place)) * map.channels);
      }
    }
  }
  return map;
}

/// Of waves over the surface, so short that the third mip still shows them.
BakedMap waves(const GeometryImage& image) {
  return filled_map(MapKind::kOcclusion, image, [&](const Atlas& atlas, const AtlasPlace& place) {
    const Vec3d p = point_at(image, atlas, place);
    return std::array{static_cast<float>(0.5 + 0.2 * std::sin(7 * p.x + 1) + 0.2 * std::sin(6 * p.y - 5 * p.z))};
  });
}

std::vector<MipLevel> box_mips(const BakedMap& map) {
  std::vector<MipLevel> all;
  for (std::int32_t side = 2; side <= map.width(); side *= 2) {
    MipLevel level{map.width() / side, map.height() / side, {}};
    for (std::int32_t y = 0; y < level.height; ++y) {
      for (std::int32_t x = 0; x < level.width; ++x) {
        double sum = 0;
        for (std::int32_t k = 0; k < side * side; ++k) {
          sum += map.texels[static_cast<std::size_t>(y * side + k / side) * map.width() + x * side + k % side];
        }
        level.texels.push_back(static_cast<float>(sum / (side * side)));
      }
    }
    all.push_back(std::move(level));
  }
  return all;
}

/// What a renderer's bilinear look-up gives at the place (u, v) of a patch.
double lookup(const MapLayout& layout, const MipLevel& level, std::int32_t patch, double u, double v) {
  const Vec2d at = layout.texcoord(patch, u, v);
  const double x = at.x * level.width - 0.5;
  const double y = at.y * level.height - 0.5;
  const auto i = static_cast<std::int32_t>(std::floor(x));
  const auto j = static_cast<std::int32_t>(std::floor(y));
  const auto texel = [&](std::int32_t a, std::int32_t b) {
    return double{level.texels[static_cast<std::size_t>(std::clamp(b, 0, level.height - 1)) * level.width +
                               std::clamp(a, 0, level.width - 1)]};
  };
  const double s = x - i;
  const double t = y - j;
  return (texel(i, j) * (1 - s) + texel(i + 1, j) * s) * (1 - t) +
         (texel(i, j + 1) * (1 - s) + texel(i + 1, j + 1) * s) * t;
}

/// (u, v) of a place on a side.
Vec2d on_side(std::int32_t side, double along) {
  const std::array<Vec2d, 4> places{Vec2d(along, 0), Vec2d(1, along), Vec2d(1 - along, 1), Vec2d(0, 1 - along)};
  return places[static_cast<std::size_t>(side)];
}

/// How far look-ups from the two patches of a border are apart at most, between these shares of its length.
double worst_seam(const GeometryImage& image, const MapLayout& layout, const MipLevel& level, double from, double to) {
  double worst = 0;
  for (std::int32_t p = 0; p < image.size(); ++p) {
    for (std::int32_t side = 0; side < 4; ++side) {
      const PatchSide other = image.layout.adjacency[p][side];
      if (other.patch < 0) continue;
      for (int k = 0; k <= 64; ++k) {
        const double along = from + (to - from) * k / 64;
        const Vec2d here = on_side(side, along);
        const Vec2d there = on_side(other.side, 1 - along);
        worst = std::max(worst, std::abs(lookup(layout, level, p, here.x, here.y) -
                                         lookup(layout, level, other.patch, there.x, there.y)));
      }
    }
  }
  return worst;
}

TEST(SurfaceMips, GoDownToOneTexel) {
  const GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 2);
  const BakedMap map = waves(image);
  const std::vector<MipLevel> mips = surface_mips(map, image.layout);
  ASSERT_EQ(mips.size(), 9U);
  ASSERT_EQ(mip_count(map), 10);
  for (std::size_t l = 0; l < mips.size(); ++l) {
    EXPECT_EQ(mips[l].width, kSide >> (l + 1));
    EXPECT_EQ(mips[l].height, kSide >> (l + 1));
    EXPECT_EQ(mips[l].texels.size(), static_cast<std::size_t>(mips[l].width) * mips[l].height);
  }
}

TEST(SurfaceMips, OfOneValueAreThatValueEverywhere) {
  for (const Case& c : cases()) {
    const BakedMap map =
        filled_map(MapKind::kOcclusion, c.image, [](const Atlas&, const AtlasPlace&) { return std::array{0.25F}; });
    for (const MipLevel& level : surface_mips(map, c.image.layout)) {
      for (const float texel : level.texels) ASSERT_EQ(texel, 0.25F) << c.name << ", " << level.width;
    }
  }
}

TEST(SurfaceMips, EndWithTheMeanOfThePatches) {
  for (const Case& c : cases()) {
    const BakedMap map = waves(c.image);
    double sum = 0;
    std::int64_t count = 0;
    const std::int32_t gutter = map.layout.gutter_of(map.layout.tile);
    for (std::int32_t p = 0; p < c.image.size(); ++p) {
      const MapTile tile = map.layout.tile_of(p);
      for (std::int32_t y = 0; y < tile.inner(); ++y) {
        for (std::int32_t x = 0; x < (c.image.layout.places[p].right.exists() ? tile.inner() : y + 1); ++x) {
          sum += map.texels[static_cast<std::size_t>(tile.y + gutter + y) * map.width() + tile.x + gutter + x];
          ++count;
        }
      }
    }
    EXPECT_NEAR(surface_mips(map, c.image.layout).back().texels[0], sum / static_cast<double>(count), 1e-5) << c.name;
  }
}

TEST(SurfaceMips, AreBoxesOfTilesButAtCorners) {
  for (const Case& c : cases()) {
    const BakedMap map = waves(c.image);
    const std::vector<MipLevel> mips = surface_mips(map, c.image.layout);
    const std::vector<MipLevel> boxes = box_mips(map);
    ASSERT_EQ(map.layout.clean_mips(), 3);
    for (std::int32_t l = 1; l <= 3; ++l) {
      const std::int32_t side = 1 << l;
      for (std::int32_t p = 0; p < c.image.size(); ++p) {
        const MapTile tile = map.layout.tile_of(p);
        const std::int32_t beyond = (tile.gutter + side - 1) / side;
        const std::int32_t texels = tile.size / side;
        for (std::int32_t k = 0; k < texels * texels; ++k) {
          const std::int32_t x = k % texels;
          const std::int32_t y = k / texels;
          const bool at_corner = std::min(x, texels - 1 - x) < beyond && std::min(y, texels - 1 - y) < beyond;
          const std::size_t at = static_cast<std::size_t>(tile.y / side + y) * mips[l - 1].width + tile.x / side + x;
          if (at_corner) continue;
          ASSERT_NEAR(mips[l - 1].texels[at], boxes[l - 1].texels[at], 1e-6) << c.name << ", " << l;
        }
      }
    }
  }
}

TEST(SurfaceMips, ShowNoSeamWhereGuttersAreWideEnough) {
  for (const Case& c : spheres()) {
    const BakedMap map = waves(c.image);
    ASSERT_EQ(map.layout.clean_mips(), 3);
    const std::vector<MipLevel> mips = surface_mips(map, c.image.layout);
    const std::vector<MipLevel> boxes = box_mips(map);
    for (std::size_t l = 0; l < 3; ++l) {
      // Waves are 0.8 high. Both sides of a border make the same mistakes, but for roundness: less than a step of 8
      // bits.
      const double own = worst_seam(c.image, map.layout, mips[l], 0, 1);
      EXPECT_LT(own, 1.0 / 255) << c.name << ", " << l;
      EXPECT_LT(worst_seam(c.image, map.layout, boxes[l], 0.25, 0.75), 1.0 / 255) << c.name << ", " << l;
      // Boxes have seams at corners, by as much as patches there aren't the square's four.
      EXPECT_LT(own, 0.1 * worst_seam(c.image, map.layout, boxes[l], 0, 1)) << c.name << ", " << l;
    }
  }
}

TEST(SurfaceMips, OfASmallMapAreThoseOfTheLargeOne) {
  for (const Case& c : spheres()) {
    const BakedMap map = waves(c.image);
    const std::vector<MipLevel> boxes = box_mips(map);
    BakedMap half = neutral_map(MapKind::kOcclusion, map.layout, 0, 2);
    half.texels = boxes[0].texels;
    const std::vector<MipLevel> of_half = surface_mips(half, c.image.layout);
    const std::vector<MipLevel> of_whole = surface_mips(map, c.image.layout);
    ASSERT_EQ(of_half.size() + 1, of_whole.size());
    for (std::size_t l = 0; l < of_half.size(); ++l) {
      ASSERT_EQ(of_half[l].width, of_whole[l + 1].width);
      for (std::size_t t = 0; t < of_half[l].texels.size(); ++t) {
        // At corners the small map's texels are means of what they stand for; waves are that much apart.
        ASSERT_NEAR(of_half[l].texels[t], of_whole[l + 1].texels[t], 0.02) << c.name << ", " << l;
      }
    }
  }
}

TEST(SurfaceMips, OfDirectionsAreUnitVectors) {
  for (const Case& c : cases()) {
    const BakedMap map = filled_map(MapKind::kObjectNormal, c.image, [&](const Atlas& atlas, const AtlasPlace& place) {
      const Vec3f n(point_at(c.image, atlas, place).normalized());
      return std::array{n.x, n.y, n.z};
    });
    for (const MipLevel& level : surface_mips(map, c.image.layout)) {
      for (std::size_t t = 0; t < level.texels.size(); t += 3) {
        const Vec3d n(level.texels[t], level.texels[t + 1], level.texels[t + 2]);
        ASSERT_NEAR(n.length(), 1, 1e-5) << c.name << ", " << level.width;
      }
    }
  }
}

TEST(SurfaceMips, TakeNoColourFromWhatIsClear) {
  const GeometryImage image = fixtures::sphere_image(fixtures::icosahedron(), 3);
  const BakedMap map = filled_map(MapKind::kBaseColour, image, [](const Atlas&, const AtlasPlace& place) {
    const bool clear = (static_cast<int>(place.x) + static_cast<int>(place.y)) % 2 != 0;
    return clear ? std::array{0.0F, 1.0F, 0.0F, 0.0F} : std::array{0.5F, 0.0F, 0.0F, 1.0F};
  });
  for (const MipLevel& level : surface_mips(map, image.layout)) {
    for (std::size_t t = 0; t < level.texels.size(); t += 4) {
      if (level.texels[t + 3] == 0) continue;
      ASSERT_NEAR(level.texels[t], 0.5, 1e-6);
      ASSERT_NEAR(level.texels[t + 1], 0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace lozenge
