#include "formats/patches/map_kinds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string_view>

namespace lozenge {
namespace {

TEST(MapKinds, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names, options, file_parts;
  for (const MapTraits& traits : kMapKinds) {
    EXPECT_TRUE(names.insert(traits.name).second);
    EXPECT_TRUE(options.insert(traits.option).second);
    EXPECT_TRUE(file_parts.insert(traits.file_part).second);
  }
}

TEST(MapKinds, AreNeutralWithinTheirRange) {
  for (const MapTraits& traits : kMapKinds) {
    ASSERT_GE(traits.channels, 1);
    ASSERT_LE(traits.channels, 4);
    const auto [least, most] = range_of(traits.values);
    for (std::int32_t c = 0; c < traits.channels; ++c) {
      EXPECT_GE(traits.neutral[c], least);
      EXPECT_LE(traits.neutral[c], most);
    }
  }
}

TEST(MapKinds, ShareASlotOfTheMaterialWhereOneHoldsTheOtherOrTheyAreForOtherTriangles) {
  std::map<MaterialSlot, const MapTraits*> taken;
  for (const MapTraits& traits : kMapKinds) {
    for (const MaterialSlot slot : traits.slots) {
      if (slot == MaterialSlot::kNone) continue;
      const auto [at, is_first] = taken.try_emplace(slot, &traits);
      const MapTraits& other = *at->second;
      const bool holds_it = other.kind == MapKind::kOcclusion && traits.kind == MapKind::kOcclusionRoughnessMetal;
      EXPECT_TRUE(is_first || holds_it || other.frames != traits.frames) << other.name << " and " << traits.name;
    }
  }
}

TEST(MapKinds, GiveTheSameIntegersAgainInEveryColourSpace) {
  for (const MapValues values : {MapValues::kDirections, MapValues::kShares}) {
    for (const ColourSpace colours : {ColourSpace::kLinear, ColourSpace::kSrgb}) {
      if (values == MapValues::kDirections && colours == ColourSpace::kSrgb) continue;  // they are no colours
      MapTraits traits = traits_of(MapKind::kOcclusion);
      traits.values = values;
      traits.colours = colours;
      for (const int most : {255, 65535}) {
        for (int step = 0; step <= most; ++step) {
          const auto value = static_cast<float>(value_of_share(traits, 0, static_cast<double>(step) / most));
          EXPECT_EQ(std::lround(stored_share(traits, 0, value) * most), step);
        }
      }
    }
  }
}

TEST(MapKinds, StoreColoursAsSrgbDoesAndTheirCoverAsItIs) {
  MapTraits traits = traits_of(MapKind::kOcclusion);
  traits.colours = ColourSpace::kSrgb;
  // Middle grey of sRGB reflects a little more than a fifth of the light (IEC 61966-2-1).
  EXPECT_NEAR(stored_share(traits, 0, 0.2140), 0.5, 1e-4);
  EXPECT_NEAR(value_of_share(traits, 2, 0.5), 0.2140, 1e-4);
  EXPECT_EQ(stored_share(traits, 3, 0.25), 0.25);
  EXPECT_EQ(value_of_share(traits, 3, 0.25), 0.25);
}

}  // namespace
}  // namespace lozenge
