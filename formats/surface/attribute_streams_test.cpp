// Whatever a stream holds: what is taken over keeps its bits, and what lies between others follows the stream's kind.
#include "formats/surface/attribute_streams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "formats/surface/attribute_fixtures.h"

namespace lozenge {
namespace {

using fixtures::kBones;
using fixtures::kFlow;
using fixtures::kHeat;
using fixtures::kPlantedKinds;
using fixtures::kTag;

std::vector<AttributeKind> all_kinds() {
  std::vector<AttributeKind> kinds(kAttributeKinds.begin(), kAttributeKinds.end());
  kinds.insert(kinds.end(), kPlantedKinds.begin(), kPlantedKinds.end());
  return kinds;
}

/// A value such as a mesh may hold.
std::vector<float> random_value(const AttributeKind& kind, std::mt19937& random) {
  std::uniform_real_distribution<float> share(0.01F, 1);
  std::vector<float> value(static_cast<std::size_t>(kind.components));
  for (float& x : value) x = share(random);
  if (kind.interpolation == Interpolation::kDirection) {
    const Vec3f unit = (Vec3f(value[0], value[1], value[2]) - Vec3f(0.5F)).normalized();
    value = {unit.x, unit.y, unit.z};
  }
  if (kind.interpolation == Interpolation::kJointsAndWeights) {
    const std::size_t most = value.size() / 2;
    const float total = std::accumulate(value.begin() + static_cast<std::ptrdiff_t>(most), value.end(), 0.0F);
    for (std::size_t i = 0; i < most; ++i) {
      value[i] = static_cast<float>(4 * i + random() % 4);  // each joint once
      value[most + i] /= total;
    }
  }
  return value;
}

/// Some of all kinds, of two sets where files number them.
AttributeStreams random_streams(std::size_t count, std::mt19937& random) {
  AttributeStreams streams;
  for (const AttributeKind& kind : all_kinds()) {
    for (int set = 0; set < (kind.numbered ? 2 : 1); ++set) {
      if (random() % 3 == 0) continue;
      std::vector<float>& values = stream_for(streams, kind, set).values;
      for (std::size_t i = 0; i < count; ++i) {
        const std::vector<float> value = random_value(kind, random);
        values.insert(values.end(), value.begin(), value.end());
      }
    }
  }
  return streams;
}

std::vector<float> value_of(const AttributeStream& stream, std::size_t element) {
  return {stream.at(element), stream.at(element) + stream.kind.components};
}

void expect_same_value(const AttributeStreams& a, std::size_t i, const AttributeStreams& b, std::size_t j) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t s = 0; s < a.size(); ++s) ASSERT_EQ(value_of(a[s], i), value_of(b[s], j)) << a[s].kind.semantic;
}

void expect_same_triangle(const AttributeStreams& a, std::size_t t, const AttributeStreams& b, std::size_t u) {
  for (std::size_t c = 0; c < 3; ++c) expect_same_value(a, 3 * t + c, b, 3 * u + c);
}

void expect_counts(const AttributeStreams& streams, std::size_t count) {
  for (const AttributeStream& stream : streams) {
    ASSERT_EQ(stream.values.size(), count * static_cast<std::size_t>(stream.kind.components));
  }
}

template <typename Check>
void for_random_streams(Check check) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const std::size_t triangles = 1 + random() % 20;
    check(random_streams(3 * triangles, random), triangles, random);
  }
}

TEST(AttributeKinds, HaveNoMoreComponentsThanThereIsRoomForAndNamesOfTheirOwn) {
  for (const AttributeKind& kind : kAttributeKinds) {
    EXPECT_GE(kind.components, 1);
    EXPECT_LE(kind.components, kMostComponents);
    EXPECT_LE(kind.fewest_components, kind.components);
    EXPECT_TRUE(kind.numbered || kind.sets == 1) << "files couldn't tell its sets apart";
    EXPECT_EQ(std::count(kAttributeKinds.begin(), kAttributeKinds.end(), kind), 1);
    EXPECT_TRUE(kind.movement != Movement::kNormal || kind.components == 3);
  }
  EXPECT_EQ(attribute_name(kNormals, 0), "NORMAL");
  EXPECT_EQ(attribute_name(kTextureCoordinates, 1), "TEXCOORD_1");
}

TEST(AttributeStreams, AreInTheOrderOfTheTableHoweverTheyWereAdded) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<AttributeKind> kinds = all_kinds();
    std::shuffle(kinds.begin(), kinds.end(), std::mt19937(seed));
    AttributeStreams streams;
    for (const AttributeKind& kind : kinds) stream_for(streams, kind);
    stream_for(streams, kTextureCoordinates, 1);
    for (const AttributeKind& kind : kinds) stream_for(streams, kind);
    std::vector<std::string> names;
    for (const AttributeStream& stream : streams) names.push_back(attribute_name(stream.kind, stream.set));
    EXPECT_EQ(names,
              std::vector<std::string>({"NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0",
                                        "_LOZENGE_INFLUENCES", "_LOZENGE_MORPH_OFFSET_0", "_LOZENGE_MORPH_NORMAL_0",
                                        "_LOZENGE_SHEET", "_BONES", "_FLOW", "_HEAT", "_TAG"}));
  }
}

TEST(AttributeStreams, KeepTheirBitsWhereTrianglesAreReorderedLeftOutAndTakenOver) {
  for_random_streams([](const AttributeStreams& before, std::size_t triangles, std::mt19937& random) {
    std::vector<TriangleId> order;
    for (std::size_t i = 0; i < 2 * triangles; ++i) order.push_back(static_cast<TriangleId>(random() % triangles));
    AttributeStreams reordered = before;
    reorder_triangles(reordered, order);
    expect_counts(reordered, 3 * order.size());

    std::vector<bool> keep(triangles);
    for (std::size_t t = 0; t < triangles; ++t) keep[t] = random() % 2 == 0;
    AttributeStreams kept = before;
    keep_triangles(kept, keep);

    AttributeStreams taken = empty_like(before);
    std::size_t next = 0;
    for (std::size_t t = 0; t < triangles; ++t) {
      if (!keep[t]) continue;
      expect_same_triangle(kept, next++, before, t);
      append_triangle(taken, before, static_cast<TriangleId>(t));
    }
    expect_counts(kept, 3 * next);
    EXPECT_TRUE(fixtures::same_bits(taken, kept));
    for (std::size_t i = 0; i < order.size(); ++i) {
      expect_same_triangle(reordered, i, before, static_cast<std::size_t>(order[i]));
    }
  });
}

TEST(AttributeStreams, KeepTheirBitsWhereTheyAreJoinedAndAreNeutralWhereTheyWerent) {
  for_random_streams([](const AttributeStreams& first, std::size_t triangles, std::mt19937& random) {
    const std::size_t count = 3 * triangles;
    const AttributeStreams second = random_streams(7, random);
    AttributeStreams joined = first;
    join(joined, count, second, 7);
    expect_counts(joined, count + 7);
    for (const AttributeStream& stream : joined) {
      const std::vector<float> neutral(static_cast<std::size_t>(stream.kind.components), stream.kind.neutral);
      const AttributeStream* in_first = find_stream(first, stream.kind, stream.set);
      const AttributeStream* in_second = find_stream(second, stream.kind, stream.set);
      ASSERT_TRUE(in_first || in_second);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(value_of(stream, i), in_first ? value_of(*in_first, i) : neutral);
      }
      for (std::size_t i = 0; i < 7; ++i) {
        ASSERT_EQ(value_of(stream, count + i), in_second ? value_of(*in_second, i) : neutral);
      }
    }
  });
}

TEST(AttributeStreams, AppendAnElementOfTheirOwn) {
  for_random_streams([](AttributeStreams streams, std::size_t triangles, std::mt19937& random) {
    const AttributeStreams before = streams;
    const std::size_t element = random() % (3 * triangles);
    append_element(streams, streams, element);
    expect_counts(streams, 3 * triangles + 1);
    expect_same_value(streams, 3 * triangles, before, element);
  });
}

TEST(AttributeStreams, HalveATriangleWithItsOuterCornersAsTheyWereAndTheNewOneBetween) {
  for_random_streams([](const AttributeStreams& before, std::size_t triangles, std::mt19937& random) {
    const std::size_t corner = random() % (3 * triangles);
    const std::size_t next = corner - corner % 3 + (corner + 1) % 3;
    const std::size_t previous = corner - corner % 3 + (corner + 2) % 3;
    const double share = std::uniform_real_distribution<double>(0.05, 0.95)(random);
    AttributeStreams halves = before;
    halve_triangle(halves, corner, share);
    expect_counts(halves, 3 * triangles + 3);
    const std::array<WeightedElement, 2> ends{{{corner, 1 - share}, {next, share}}};
    const AttributeStreams middle = interpolated(before, ends);
    for (std::size_t c = 0; c < 3 * triangles; ++c) {
      if (c != next) expect_same_value(halves, c, before, c);
    }
    expect_same_value(halves, next, middle, 0);
    expect_same_value(halves, 3 * triangles, middle, 0);
    expect_same_value(halves, 3 * triangles + 1, before, next);
    expect_same_value(halves, 3 * triangles + 2, before, previous);
  });
}

TEST(InterpolateStreams, GivesAnElementBackThatHasAllTheWeightOrWhoseValueAllHave) {
  for_random_streams([](AttributeStreams streams, std::size_t triangles, std::mt19937& random) {
    const std::size_t element = random() % (3 * triangles);
    append_element(streams, streams, element);
    const std::array<WeightedElement, 3> elements{{{0, 0}, {element, 0.3}, {3 * triangles, 0.7}}};
    const AttributeStreams made = interpolated(streams, elements);
    for (std::size_t s = 0; s < streams.size(); ++s) {
      std::vector<float> was = value_of(streams[s], element);
      std::vector<float> is = value_of(made[s], 0);
      if (streams[s].kind.interpolation == Interpolation::kJointsAndWeights) {
        for (std::vector<float>* values : {&was, &is}) {  // the heaviest comes first now
          const auto half = values->begin() + static_cast<std::ptrdiff_t>(values->size() / 2);
          std::sort(values->begin(), half);
          std::sort(half, values->end());
        }
      }
      for (std::size_t c = 0; c < was.size(); ++c) ASSERT_NEAR(is[c], was[c], 1e-6);
    }
  });
}

TEST(InterpolateStreams, TakesTheWeightedMeanOfLinearOnesWhateverTheWeightsSumIs) {
  const AttributeStream heat{kHeat, 0, {1, 10, 2, 20, 4, 40}};
  const std::array<WeightedElement, 3> elements{{{0, 2}, {1, 2}, {2, 4}}};
  std::array<float, 2> value{};
  interpolate(heat, elements, value.data());
  EXPECT_EQ(value, (std::array<float, 2>{2.75F, 27.5F}));
}

TEST(InterpolateStreams, KeepsDirectionsOfUnitLengthAndGivesZerosWhereTheyCancel) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    AttributeStream flow{kFlow, 0, {}};
    std::vector<WeightedElement> elements;
    for (std::size_t k = 0; k < 2 + random() % 4; ++k) {
      const std::vector<float> unit = random_value(kFlow, random);
      flow.values.insert(flow.values.end(), unit.begin(), unit.end());
      elements.push_back({k, std::uniform_real_distribution<double>(0.1, 3)(random)});
    }
    Vec3f between;
    interpolate(flow, elements, &between.x);
    EXPECT_NEAR(between.length(), 1, 1e-6);
  }
  const AttributeStream opposite{kFlow, 0, {0.6F, 0, 0.8F, -0.6F, 0, -0.8F}};
  const std::array<WeightedElement, 2> both{{{0, 0.5}, {1, 0.5}}};
  Vec3f none(1, 1, 1);
  interpolate(opposite, both, &none.x);
  EXPECT_EQ(none, Vec3f(0, 0, 0));
  EXPECT_FALSE(std::signbit(none.x));
}

TEST(InterpolateStreams, KeepsTheHeaviestJointsWithWeightsOfSumOne) {
  const AttributeStream bones{kBones, 0, {1, 2, 3, 4, 0.5F, 0.3F, 0.15F, 0.05F, 9, 1, 8, 7, 0.6F, 0.2F, 0.1F, 0.1F}};
  const std::array<WeightedElement, 2> half{{{0, 0.5}, {1, 0.5}}};
  std::array<float, 8> value{};
  interpolate(bones, half, value.data());
  // 1: 0.35, 9: 0.3, 2: 0.15, 3: 0.075; 8, 7 and 4 have less.
  EXPECT_EQ(std::vector<float>(value.begin(), value.begin() + 4), std::vector<float>({1, 9, 2, 3}));
  EXPECT_NEAR(value[4], 0.35 / 0.875, 1e-6);
  EXPECT_NEAR(std::accumulate(value.begin() + 4, value.end(), 0.0), 1, 1e-6);
}

TEST(InterpolateStreams, TakesTheNearestOfThoseThatHaveNothingBetween) {
  const AttributeStream tags{kTag, 0, {3, 5, 8}};
  const auto nearest = [&](double a, double b, double c) {
    const std::array<WeightedElement, 3> elements{{{0, a}, {1, b}, {2, c}}};
    float value = 0;
    interpolate(tags, elements, &value);
    return value;
  };
  EXPECT_EQ(nearest(0.2, 0.5, 0.3), 5);
  EXPECT_EQ(nearest(0.4, 0.2, 0.4), 3);
}

TEST(TurnTriangle, SwapsTwoCornersAndNegatesOnlyNormalsThatFacedOutward) {
  for_random_streams([](const AttributeStreams& before, std::size_t triangles, std::mt19937& random) {
    const auto t = static_cast<TriangleId>(random() % triangles);
    const std::size_t first = 3 * static_cast<std::size_t>(t);
    const Vec3d outside(1, -0.5, 0.25);
    AttributeStreams turned = before;
    turn_triangle(turned, t, outside);
    for (std::size_t s = 0; s < before.size(); ++s) {
      const bool normal = before[s].kind.movement == Movement::kNormal;
      Vec3d sum(0, 0, 0);
      for (std::size_t c = first; normal && c < first + 3; ++c) sum += Vec3d(vector_at<Vec3f>(before[s], c));
      const bool negated = normal && sum.dot(outside) > 0;
      for (std::size_t c = 0; c < 3 * triangles; ++c) {
        const bool own = c / 3 == static_cast<std::size_t>(t);
        std::vector<float> was = value_of(before[s], own && c % 3 != 0 ? first + 3 - c % 3 : c);
        for (float& x : was) x = own && negated ? 0 - x : x;
        ASSERT_EQ(value_of(turned[s], c), was);
      }
    }
  });
}

TEST(AppendFitted, RepairsWhatMakesNoSenseAndCountsTheElements) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const NormalTransform unmoved{Imath::M44d()};
  AttributeStream uvs{kTextureCoordinates, 0, {}};
  EXPECT_EQ(append_fitted(uvs, std::vector<float>{1, 2, 3, nan, -infinite, 5, -0.0F, 7}, unmoved), 2);
  EXPECT_EQ(uvs.values, std::vector<float>({1, 2, 0, 0, 0, 0, 0, 7}));
  EXPECT_FALSE(std::signbit(uvs.values[6]));
  AttributeStream colors{kColors, 0, {}};
  EXPECT_EQ(append_fitted(colors, std::vector<float>{0.5F, 2, -1, nan, 0, 0.25F, 1, infinite}, unmoved), 2);
  EXPECT_EQ(colors.values, std::vector<float>({0.5F, 1, 0, 1, 0, 0.25F, 1, 1}));
  AttributeStream normals{kNormals, 0, {}};
  EXPECT_EQ(append_fitted(normals, std::vector<float>{0, 0, 2, nan, 0, 1}, unmoved), 1);
  EXPECT_EQ(normals.values, std::vector<float>({0, 0, 1, 0, 0, 0}));
}

TEST(AppendFitted, MovesNormalsAlongAndNothingElse) {
  Imath::M44d stretch;
  stretch.setScale(Vec3d(1, 4, 1));
  AttributeStream normals{kNormals, 0, {}};
  append_fitted(normals, std::vector<float>{0.6F, 0.8F, 0}, NormalTransform(stretch));
  EXPECT_LT((vector_at<Vec3f>(normals, 0) - Vec3f(0.6F, 0.2F, 0).normalized()).length(), 1e-6F);
  AttributeStream flow{kFlow, 0, {}};
  append_fitted(flow, std::vector<float>{0.6F, 0.8F, 0}, NormalTransform(stretch));
  EXPECT_EQ(flow.values, std::vector<float>({0.6F, 0.8F, 0}));
}

}  // namespace
}  // namespace lozenge
