#include "formats/domain/domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "formats/base/error.h"
#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

using Corners = std::vector<std::array<DomainVertex, 3>>;

/// A torus of m x n squares, each cut in two; m, n >= 3.
Domain torus(int m, int n) {
  Corners corners;
  const auto id = [&](int i, int j) { return (i % m) * n + j % n; };
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      corners.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
      corners.push_back({id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return make_domain(corners, m * n);
}

/// A disc: n triangles around a vertex.
Domain disc(int n) {
  Corners corners;
  for (int i = 0; i < n; ++i) corners.push_back({0, 1 + i, 1 + (i + 1) % n});
  return make_domain(corners, n + 1);
}

/// A row of triangles with a boundary all around.
Domain strip(int n) {
  Corners corners;
  for (int i = 0; i < n; ++i) corners.push_back(i % 2 == 0 ? std::array{i, i + 1, i + 2} : std::array{i + 1, i, i + 2});
  return make_domain(corners, n + 2);
}

std::vector<Domain> examples() {
  return {fixtures::tetrahedron(),
          fixtures::octahedron(),
          fixtures::icosahedron(),
          torus(3, 3),
          torus(4, 7),
          disc(3),
          disc(9),
          strip(1),
          strip(2),
          strip(12)};
}

TEST(Domain, IsSoundAsItIsMade) {
  for (const Domain& domain : examples()) EXPECT_EQ(find_defect(domain), std::nullopt);
}

TEST(Domain, HasTheEulerCharacteristicOfItsSurface) {
  for (const Domain& sphere : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    EXPECT_EQ(euler_characteristic(sphere), 2);
  }
  for (int m = 3; m < 8; ++m) {
    for (int n = 3; n < 8; ++n) EXPECT_EQ(euler_characteristic(torus(m, n)), 0);
    EXPECT_EQ(euler_characteristic(disc(m)), 1);
    EXPECT_EQ(euler_characteristic(strip(m)), 1);
  }
}

TEST(Domain, VisitsEachCornerOnceWhenTurningAroundEachVertex) {
  for (const Domain& domain : examples()) {
    const std::vector<DomainCorner> first = corner_of_each_vertex(domain);
    const std::vector<std::int32_t> valence = valences(domain);
    std::vector<int> visits(static_cast<std::size_t>(domain.size()) * 3, 0);
    for (DomainVertex v = 0; v < domain.vertex_count; ++v) {
      const std::vector<DomainCorner> around = corners_around(domain, first[v]);
      EXPECT_EQ(static_cast<std::int32_t>(around.size()), valence[v]);
      for (std::size_t i = 0; i < around.size(); ++i) {
        EXPECT_EQ(domain.corner(around[i].triangle, around[i].corner), v);
        ++visits[3 * around[i].triangle + around[i].corner];
        if (i == 0) continue;
        // Counter-clockwise: the side that leaves v is the one that entered v in the triangle before.
        const DomainSide leaves{around[i].triangle, around[i].corner};
        const DomainSide enters{around[i - 1].triangle, (around[i - 1].corner + 2) % 3};
        EXPECT_EQ(domain.neighbour(enters), leaves);
      }
    }
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
  }
}

TEST(Domain, CountsEveryCornerInItsValences) {
  for (const Domain& domain : examples()) {
    const std::vector<std::int32_t> valence = valences(domain);
    EXPECT_EQ(std::accumulate(valence.begin(), valence.end(), 0), 3 * domain.size());
  }
}

TEST(Domain, ListsEveryEdgeOnceAndInOrder) {
  for (const Domain& domain : examples()) {
    const std::vector<DomainSide> all = edges(domain);
    std::vector<int> seen(static_cast<std::size_t>(domain.size()) * 3, 0);
    int last = -1;
    for (const DomainSide side : all) {
      const int number = 3 * side.triangle + side.side;
      EXPECT_GT(number, last);
      last = number;
      ++seen[number];
      const DomainSide other = domain.neighbour(side);
      if (other.exists()) ++seen[3 * other.triangle + other.side];
    }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  }
}

TEST(Domain, CountsConesInsideAndOnTheBoundary) {
  EXPECT_EQ(count_irregular(fixtures::octahedron()), 6);
  EXPECT_EQ(count_irregular(fixtures::icosahedron()), 12);
  EXPECT_EQ(count_irregular(torus(5, 4)), 0);
  EXPECT_EQ(count_irregular(disc(6)), 6) << "the middle is flat, the rim's corners have 2 triangles instead of 3";
  EXPECT_EQ(count_irregular(disc(5)), 6);
  EXPECT_EQ(count_irregular(strip(12)), 4) << "straight sides, four corners";
}

TEST(MakeDomain, RefusesSidesThatRunTheSameWay) {
  EXPECT_THROW(make_domain({{0, 1, 2}, {0, 1, 3}}, 4), Error);
  EXPECT_THROW(make_domain({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5), Error);
}

/// Ways to break a sound domain at a triangle and a side of it. Not all of them break it everywhere.
enum class Damage {
  kCorner,
  kCornerRange,
  kDropNeighbour,
  kNeighbourRange,
  kSideRange,
  kOtherNeighbour,
  kSelf,
  kVertices,
  kLast
};

void damage(Domain& domain, Damage kind, std::mt19937& random) {
  const auto t = static_cast<DomainTriangleId>(random() % domain.triangles.size());
  const int s = static_cast<int>(random() % 3);
  DomainTriangle& triangle = domain.triangles[t];
  switch (kind) {
    case Damage::kCorner:
      triangle.corners[s] = (triangle.corners[s] + 1) % domain.vertex_count;
      break;
    case Damage::kCornerRange:
      triangle.corners[s] = random() % 2 == 0 ? domain.vertex_count : -1;
      break;
    case Damage::kDropNeighbour:
      triangle.neighbours[s] = {};
      break;
    case Damage::kNeighbourRange:
      triangle.neighbours[s].triangle = domain.size();
      break;
    case Damage::kSideRange:
      triangle.neighbours[s] = {(t + 1) % domain.size(), random() % 2 == 0 ? 3 : -1};
      break;
    case Damage::kOtherNeighbour:
      triangle.neighbours[s] = {(t + 1) % domain.size(), s};
      break;
    case Damage::kSelf:
      triangle.neighbours[s] = {t, s};
      break;
    default:
      ++domain.vertex_count;
      break;
  }
}

bool same(const Domain& a, const Domain& b) {
  if (a.vertex_count != b.vertex_count || a.size() != b.size()) return false;
  for (DomainTriangleId t = 0; t < a.size(); ++t) {
    if (a.triangles[t].corners != b.triangles[t].corners || a.triangles[t].neighbours != b.triangles[t].neighbours)
      return false;
  }
  return true;
}

TEST(FindDefect, FindsEveryKindOfDamageToClosedDomains) {
  std::mt19937 random(1);
  for (const Domain& sound : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron(), torus(4, 5)}) {
    for (int kind = 0; kind < static_cast<int>(Damage::kLast); ++kind) {
      for (int i = 0; i < 100; ++i) {
        Domain domain = sound;
        damage(domain, static_cast<Damage>(kind), random);
        if (same(domain, sound)) continue;  // the neighbour was that one before
        EXPECT_TRUE(find_defect(domain)) << "kind " << kind;
      }
    }
  }
}

TEST(FindDefect, FindsTwoFansAtOneVertex) {
  // Two tetrahedra that share vertex 0 and nothing else.
  Corners corners;
  for (const DomainTriangle& t : fixtures::tetrahedron().triangles) corners.push_back(t.corners);
  for (const DomainTriangle& t : fixtures::tetrahedron().triangles) {
    std::array<DomainVertex, 3> shifted = t.corners;
    for (DomainVertex& v : shifted) v = v == 0 ? 0 : v + 3;
    corners.push_back(shifted);
  }
  const auto defect = find_defect(make_domain(corners, 7));
  ASSERT_TRUE(defect);
  EXPECT_NE(defect->find("vertex 0"), std::string::npos) << *defect;
}

}  // namespace
}  // namespace lozenge
