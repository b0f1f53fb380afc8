#include "formats/patches/patch_strips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "formats/base/error.h"
#include "formats/patches/mapped_fixtures.h"
#include "formats/patches/source_cut.h"
#include "formats/patches/source_level.h"
#include "formats/patches/strip_layout.h"

namespace lozenge {
namespace {

using Subject = fixtures::MappedSurface;

std::vector<Subject> subjects() { return fixtures::mapped_surfaces({7}, false); }

TEST(PatchStrips, HoldEveryPatchOnceAndNoneLongerThanAsked) {
  for (const Subject& subject : subjects()) {
    const PatchLayout patches = patch_layout(subject.mesh, subject.map, 17);
    for (const int longest : {1, 2, 3, 100}) {
      std::multiset<std::int32_t> held;
      for (const PatchStrip& strip : patch_strips(patches, longest)) {
        EXPECT_LE(strip.length(), longest);
        for (const StripCell& cell : strip.cells) held.insert(cell.patch);
      }
      ASSERT_EQ(held.size(), patches.places.size()) << subject.name;
      for (std::int32_t p = 0; p < patches.size(); ++p) EXPECT_EQ(held.count(p), 1U);
    }
  }
}

TEST(PatchStrips, GoOnOverTheSideThatTwoPatchesShare) {
  for (const Subject& subject : subjects()) {
    const PatchLayout patches = patch_layout(subject.mesh, subject.map, 17);
    for (const PatchStrip& strip : patch_strips(patches, 100)) {
      for (std::int32_t c = 0; c + 1 < strip.length(); ++c) {
        // A side is turned along with its square; the right one is side 1, the left one side 3.
        const StripCell& here = strip.cells[c];
        const StripCell& next = strip.cells[c + 1];
        const PatchSide across = patches.adjacency[here.patch][(1 - here.turns + 4) % 4];
        EXPECT_EQ(across.patch, next.patch) << subject.name;
        EXPECT_EQ(across.side, (3 - next.turns + 4) % 4) << subject.name;
      }
    }
  }
}

TEST(PatchStrips, LeaveTwoThirdsOfTheBordersOfAClosedSurfaceAsSeamsAtBest) {
  // Of three patches around a barycentre, two at most go straight on into each other there.
  for (const auto& domain : {fixtures::octahedron(), fixtures::icosahedron()}) {
    auto [mesh, map] = fixtures::subdivided_sphere(domain, 3);
    const PatchLayout patches = patch_layout(mesh, map, 17);
    EXPECT_GE(patch_strips(patches, 100).size(), static_cast<std::size_t>(domain.size() / 2));
    EXPECT_LE(patch_strips(patches, 100).size(), static_cast<std::size_t>(domain.size() * 3 / 4));
  }
}

TEST(PatchStrips, GiveACornerItsPlaceInTheStrip) {
  for (const Subject& subject : subjects()) {
    const PatchLayout patches = patch_layout(subject.mesh, subject.map, 17);
    const std::vector<PatchStrip> strips = patch_strips(patches, 100);
    ChartedSurface surface = charted_surface(
        subject.mesh, cut_along_patches(subject.mesh, subject.map, patches.places), [](auto) { return Vec3f(0, 0, 0); },
        [](TriangleId) { return 0; });
    join_into_strips(surface, strips);
    for (const ChartedTriangle& t : surface.triangles) {
      const Vec2d a = t.corners[0].place;
      EXPECT_GT((t.corners[1].place - a).cross(t.corners[2].place - a), -1e-12);
      for (const ChartedCorner& corner : t.corners) {
        EXPECT_GE(corner.place.x, -1e-8);
        EXPECT_LE(corner.place.x, strips[t.patch].length() + 1e-8);
        EXPECT_GE(corner.place.y, -1e-8);
        EXPECT_LE(corner.place.y, 1 + 1e-8);
      }
    }
  }
}

/// Strips of random lengths and scales.
std::vector<PatchStrip> random_strips(unsigned seed) {
  std::vector<PatchStrip> strips;
  std::uint32_t state = seed;
  const auto random = [&](std::uint32_t n) { return (state = state * 1664525 + 1013904223) / 65536 % n; };
  for (std::uint32_t s = 0; s < 3 + random(60); ++s) {
    PatchStrip strip;
    strip.cells.resize(1 + random(9));
    strip.first_level = static_cast<std::int32_t>(random(4));
    strips.push_back(strip);
  }
  return strips;
}

TEST(StripLayout, KeepsStripsApartByTheirGuttersAndInsideOfTheAtlas) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<PatchStrip> strips = random_strips(seed);
    const std::int32_t gutter = static_cast<std::int32_t>(seed % 5);
    const StripLayout layout = pack_strips(strips, 1024, gutter);
    std::vector<char> taken(1024 * 1024, 0);
    for (std::size_t s = 0; s < strips.size(); ++s) {
      const StripTile& tile = layout.tiles[s];
      for (int y = tile.y - gutter; y <= tile.y + tile.steps + gutter; ++y) {
        for (int x = tile.x - gutter; x <= tile.x + strips[s].length() * tile.steps + gutter; ++x) {
          ASSERT_TRUE(x >= 0 && y >= 0 && x < 1024 && y < 1024);
          ASSERT_EQ(taken[static_cast<std::size_t>(y) * 1024 + x]++, 0);
        }
      }
    }
  }
}

TEST(StripLayout, NamesTheLeastSizeWhereAnAtlasIsTooSmall) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<PatchStrip> strips = random_strips(seed);
    const std::int64_t least = least_strip_size(strips, 2);
    EXPECT_NO_THROW(pack_strips(strips, static_cast<std::int32_t>(least), 2));
    try {
      pack_strips(strips, static_cast<std::int32_t>(least) - 1, 2);
      ADD_FAILURE() << "it fits after all";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kLimit);
      EXPECT_NE(std::string(error.what()).find(std::to_string(least)), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace lozenge
