#include "stages/parameterize/allotment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/domain/parameterization.h"

namespace lozenge {
namespace {

/// Parts whose sizes span six orders of magnitude; some bring a domain along.
std::vector<PartFacts> random_parts(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<PartFacts> parts(2 + random() % 40);
  for (PartFacts& part : parts) {
    part.area = std::exp(2.5 * normal(random));
    part.extent = std::sqrt(part.area * (1 + std::exp(normal(random))));
    part.triangles = static_cast<std::int32_t>(4 + std::exp(5 + 2 * normal(random)));
    part.least = 4;
    if (random() % 3 == 0) {
      part.triangles = 12;
      part.own = {4, true, 0, 0.1};
    }
  }
  return parts;
}

double density(const PartFacts& part, const Allotment& share) {
  return 0.5 * (share.faces.least + share.faces.most) * area_at_level(share.first_level) / part.area;
}

TEST(Allotments, MakeDensitiesEvenWhereScalesReach) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<PartFacts> parts = random_parts(seed);
    const Allotments allotments(parts, std::nullopt);
    const std::int32_t leader = allotments.leader();
    if (leader < 0) continue;
    const FaceRange wanted = allotments.faces_of_leader();
    for (const std::int32_t faces : {wanted.least, wanted.most}) {
      const std::vector<Allotment> shares = allotments.allot(faces);
      const double there = faces * area_at_level(shares[leader].first_level) / parts[leader].area;
      for (std::size_t p = 0; p < parts.size(); ++p) {
        EXPECT_GE(shares[p].first_level, 0);
        EXPECT_LE(shares[p].first_level, kMostFirstLevel);
        if (shares[p].first_level == 0 || shares[p].first_level == kMostFirstLevel) continue;
        const double ratio = density(parts[p], shares[p]) / there;
        // A level is four times; the number of triangles makes the rest exact, within whole (and even) numbers, where
        // it may be that low.
        const bool is_bound = shares[p].is_own || shares[p].faces.least == parts[p].least;
        const double within = is_bound ? 2.3 : 1.1 + 1.0 / shares[p].faces.least;
        EXPECT_LE(ratio, within) << seed << " " << p;
        EXPECT_GE(ratio, 1 / within) << seed << " " << p;
      }
    }
  }
}

TEST(Allotments, GiveNoPartFewerTrianglesThanItsTopologyNeeds) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::vector<PartFacts> parts = random_parts(seed);
    for (PartFacts& part : parts) part.least = 14;
    for (const auto& asked : {std::optional<FaceRange>(), std::optional<FaceRange>({20, 40})}) {
      const Allotments allotments(parts, asked);
      if (allotments.leader() < 0) continue;
      for (const Allotment& share : allotments.allot(allotments.faces_of_leader().least)) {
        if (share.is_own) continue;
        EXPECT_GE(share.faces.least, 14);
        EXPECT_GT(share.faces.most, share.faces.least) << "closed surfaces have even numbers";
      }
    }
  }
}

TEST(Allotments, KeepToWhatCuttingMayAdd) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::vector<PartFacts> parts = random_parts(seed);
    double triangles = 0;
    double least = 0;
    for (PartFacts& part : parts) {
      part.triangles = std::max(part.triangles, 300);  // room for more than the smallest domain
      part.own = {};
      triangles += part.triangles;
      least += added_by_cutting(part.triangles, 4);
    }
    const Allotments allotments(parts, std::nullopt);
    double added = 0;
    const std::vector<Allotment> shares = allotments.allot(allotments.faces_of_leader().least);
    for (std::size_t p = 0; p < parts.size(); ++p) added += added_by_cutting(parts[p].triangles, shares[p].faces.least);
    EXPECT_LE(added, 1.1 * std::max(most_added(triangles), 1.5 * least)) << seed;
  }
}

TEST(Allotments, KeepAboutToWhatTheUserAsksFor) {
  std::vector<PartFacts> parts(3);
  for (std::size_t p = 0; p < parts.size(); ++p) parts[p] = {1.0 + static_cast<double>(p), 2, 5000, 4, {}};
  const Allotments allotments(parts, FaceRange{100, 200});
  double faces = 0;
  for (const Allotment& share : allotments.allot(allotments.faces_of_leader().least)) faces += share.faces.least;
  EXPECT_GE(faces, 70);
  EXPECT_LE(faces, 200);
}

TEST(Allotments, BringDomainsAlongWhereTheUserAsksForNoMore) {
  std::vector<PartFacts> parts(4, PartFacts{1, 2, 12, 4, {4, true, 0, 0.1}});
  for (const Allotment& share : Allotments(parts, std::nullopt).allot(0)) EXPECT_TRUE(share.is_own);
  for (const Allotment& share : Allotments(parts, FaceRange{8, 16}).allot(4)) EXPECT_TRUE(share.is_own);
  const Allotments finer(parts, FaceRange{40, 48});
  ASSERT_GE(finer.leader(), 0);
  for (const Allotment& share : finer.allot(10)) EXPECT_FALSE(share.is_own);
}

TEST(Allotments, GiveMoreToPartsThatAreDistortedAndLessToOthers) {
  std::vector<PartFacts> parts(3, PartFacts{1, 2, 3000, 4, {}});
  const Allotments allotments(parts, std::nullopt);
  const std::int32_t faces = allotments.faces_of_leader().least;
  const std::vector<Allotment> before = allotments.allot(faces);
  std::vector<MadePart> made(3);
  for (std::size_t p = 0; p < 3; ++p) made[p] = {static_cast<double>(faces), 0.001, 3000};
  made[1].distortion = 2;
  const std::vector<Allotment> after = allotments.revised(made);
  EXPECT_GT(after[1].faces.least, 3 * before[1].faces.least);
  EXPECT_LE(after[0].faces.least, before[0].faces.least);
}

TEST(EvenLevels, MakeDensitiesEvenWithinALevel) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<PartFacts> parts = random_parts(seed);
    std::vector<double> faces;
    for (std::size_t p = 0; p < parts.size(); ++p) faces.push_back(4 + static_cast<double>((seed + p) % 30));
    const std::vector<std::int32_t> levels = even_levels(parts, faces);
    EXPECT_EQ(*std::min_element(levels.begin(), levels.end()), 0);
    EXPECT_LE(*std::max_element(levels.begin(), levels.end()), kMostFirstLevel);
    const double mismatch = mismatch_of_areas(parts, faces, levels);
    EXPECT_LE(mismatch, mismatch_of_areas(parts, faces, std::vector<std::int32_t>(parts.size(), 0)));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (const std::int32_t other : {levels[p] - 1, levels[p] + 1}) {
        if (other < 0 || other > kMostFirstLevel) continue;
        std::vector<std::int32_t> changed = levels;
        changed[p] = other;
        // Looked for in steps of a sixteenth of a level: what lies between two levels may be on either.
        EXPECT_LE(mismatch, 1.05 * mismatch_of_areas(parts, faces, changed) + 1e-9) << seed << " " << p;
      }
    }
  }
}

TEST(WeighedWhole, CountsWhatOthersCanNotFollow) {
  // A part that needs as many triangles as the leader would be dense beside it, but for its scale.
  std::vector<PartFacts> parts(2, PartFacts{1, 1.5, 3000, 4, {}});
  const Allotments alike(parts, std::nullopt);
  parts[1].area = 1e-4;
  const Allotments small(parts, std::nullopt);
  const TraceRow row{40, 0.01, 0.1, 0, 0};
  EXPECT_GT(alike.weighed_whole(row), 0);
  // Four levels and a bit are a factor of 1e-4 almost: next to nothing is lost.
  EXPECT_LT(small.weighed_whole(row), 1.2 * alike.weighed_whole(row));
}

}  // namespace
}  // namespace lozenge
