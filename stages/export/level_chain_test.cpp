#include "stages/export/level_chain.h"

#include <gtest/gtest.h>

#include "stages/export/export_fixtures.h"

namespace lozenge {
namespace {

/// All counts of a chain whose levels come out as they are wanted. \param source  triangles of the source's own as the
/// first level; 0: none
std::vector<std::int64_t> chain_of(const GeometryImage& image, const ExportOptions& options, std::int64_t source = 0) {
  const LevelChain chain(image, level_to_export(image, options), options);
  std::vector<std::int64_t> counts{source > 0 ? source : chain.finest_count()};
  while (counts.size() < chain.most_levels() && chain.wants(chain.after(counts.back()))) {
    counts.push_back(chain.after(counts.back()));
  }
  return counts;
}

using Counts = std::vector<std::int64_t>;

TEST(LevelChain, HasTheTrianglesOfTheImagesLevelsDownToSomeHundred) {
  const GeometryImage image = export_fixtures::octahedron(33);
  EXPECT_EQ(chain_of(image, {}), (Counts{24576, 6144, 1536, 384}));
  EXPECT_EQ(chain_of(image, {.max_coarser_levels = 1}), (Counts{24576, 6144}));
  EXPECT_EQ(chain_of(image, {.max_coarser_levels = 9}), (Counts{24576, 6144, 1536, 384, 96, 24, 6, 1}));
  EXPECT_EQ(chain_of(image, {.coarser_levels = false}), (Counts{24576}));
}

TEST(LevelChain, BeginsWithTheBudgetAndGoesOnByQuarters) {
  const GeometryImage image = export_fixtures::octahedron(33);
  EXPECT_EQ(chain_of(image, {.triangle_budget = 10'000}), (Counts{10'000, 2500, 625}));
  EXPECT_EQ(chain_of(image, {.triangle_budget = 7}), (Counts{7}));
}

TEST(LevelChain, IsNeverHeavierThanTheSource) {
  GeometryImage image = export_fixtures::octahedron(33);
  image.layout.source_triangles = 5000;
  EXPECT_EQ(chain_of(image, {}), (Counts{5000, 1536, 384}));
  EXPECT_EQ(chain_of(image, {.triangle_budget = 8000}), (Counts{5000, 1250, 312}));
  EXPECT_EQ(chain_of(image, {}, 15'000), (Counts{15'000, 2500, 625})) << "its own triangles, cut";
  EXPECT_EQ(chain_of(image, {.finest = Finest::kSamples}), (Counts{24'576, 2500, 625})) << "as somebody asks for";
}

TEST(LevelChain, HasHalfTheTrianglesAtMostOfTheLevelBefore) {
  for (const std::int64_t source : {800, 1000, 3000, 3072, 3100, 20'000}) {
    const Counts counts = chain_of(export_fixtures::octahedron(33), {}, source);
    for (std::size_t l = 1; l < counts.size(); ++l) {
      EXPECT_LE(2 * counts[l], counts[l - 1]) << source;
      EXPECT_GE(6 * counts[l], counts[l - 1]) << source;
    }
    EXPECT_GE(counts.back(), 200) << source;
    EXPECT_LE(counts.back(), 1600) << source;
  }
}

}  // namespace
}  // namespace lozenge
