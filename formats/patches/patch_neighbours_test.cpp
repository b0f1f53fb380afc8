#include "formats/patches/patch_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "formats/domain/sphere_fixtures.h"

namespace lozenge {
namespace {

/// An octahedron without one of its faces, and one without the four faces around a vertex.
std::vector<Domain> open_domains() {
  std::vector<Domain> found;
  for (const bool half : {false, true}) {
    std::vector<std::array<DomainVertex, 3>> corners;
    std::vector<DomainVertex> names(6, -1);
    DomainVertex count = 0;
    for (const DomainTriangle& t : fixtures::octahedron().triangles) {
      const bool touches = t.corners[0] == 5 || t.corners[1] == 5 || t.corners[2] == 5;
      if (half ? touches : corners.size() == 7) continue;
      std::array<DomainVertex, 3> renamed{};
      for (int c = 0; c < 3; ++c) {
        DomainVertex& name = names[t.corners[c]];
        if (name < 0) name = count++;
        renamed[c] = name;
      }
      corners.push_back(renamed);
    }
    found.push_back(make_domain(corners, count));
  }
  return found;
}

std::vector<Domain> domains() {
  std::vector<Domain> found = open_domains();
  found.push_back(fixtures::tetrahedron());
  found.push_back(fixtures::octahedron());
  found.push_back(fixtures::icosahedron());
  return found;
}

struct Grid {
  std::int32_t samples;
  std::vector<PatchPlace> places;
  std::vector<std::array<PatchSide, 4>> adjacency;
};

std::vector<Grid> grids() {
  std::vector<Grid> found;
  for (const Domain& domain : domains()) {
    for (const std::int32_t samples : {2, 3, 5, 9}) {
      const auto places = patch_places(domain);
      found.push_back({samples, places, patch_adjacency(places)});
    }
  }
  return found;
}

template <typename Visit>
void for_each_sample(const Grid& grid, const PatchNeighbours& neighbours, Visit visit) {
  for (std::int32_t p = 0; p < static_cast<std::int32_t>(grid.places.size()); ++p) {
    for (std::int32_t j = 0; j < grid.samples; ++j) {
      for (std::int32_t i = 0; i < grid.samples; ++i) {
        if (neighbours.exists({p, i, j})) visit(PatchSample{p, i, j});
      }
    }
  }
}

/// A name for the place itself, from the places of the patches alone: the weights of domain vertices and barycentres.
using Place = std::map<std::pair<int, int>, int>;
Place place_of(const Grid& grid, const PatchSample& s) {
  const PatchPlace& at = grid.places[s.patch];
  const int last = grid.samples - 1;
  Place place{{{0, at.a}, last - std::max(s.i, s.j)}, {{0, at.b}, std::min(s.i, s.j)}};
  if (s.i != s.j) place[{1, s.j > s.i ? at.left.triangle : at.right.triangle}] = std::abs(s.i - s.j);
  if (s.i == s.j && s.i > 0 && s.i < last) place[{2, s.patch}] = 0;  // two edges may join the same vertices
  std::erase_if(place, [](const auto& entry) { return entry.first.first < 2 && entry.second == 0; });
  return place;
}

TEST(PatchNeighbours, AdjacencyIsReciprocalAndMissingOnHalfPatchesAlone) {
  for (const Grid& grid : grids()) {
    for (std::size_t p = 0; p < grid.places.size(); ++p) {
      for (int side = 0; side < 4; ++side) {
        const PatchSide other = grid.adjacency[p][side];
        const bool missing = side < 2 && !grid.places[p].right.exists();
        ASSERT_EQ(other.patch < 0, missing);
        if (missing) continue;
        EXPECT_EQ(grid.adjacency[other.patch][other.side], (PatchSide{static_cast<std::int32_t>(p), side}));
      }
    }
  }
}

TEST(PatchNeighbours, NamesArePreciselyTheSamplesOfTheSamePlace) {
  for (const Grid& grid : grids()) {
    const PatchNeighbours neighbours(grid.samples, grid.adjacency);
    std::map<Place, int> holders;
    for_each_sample(grid, neighbours, [&](const PatchSample& s) { ++holders[place_of(grid, s)]; });
    for_each_sample(grid, neighbours, [&](const PatchSample& s) {
      const std::vector<PatchSample> names = neighbours.names(s);
      ASSERT_EQ(static_cast<int>(names.size()), holders[place_of(grid, s)]);
      EXPECT_NE(std::find(names.begin(), names.end(), s), names.end());
      for (const PatchSample& name : names) EXPECT_EQ(place_of(grid, name), place_of(grid, s));
    });
  }
}

TEST(PatchNeighbours, AcrossASideLiesTheSameBorderAndThenTheNeighboursInside) {
  for (const Grid& grid : grids()) {
    const PatchNeighbours neighbours(grid.samples, grid.adjacency);
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(grid.places.size()); ++p) {
      for (int side = 0; side < 4; ++side) {
        for (std::int32_t k = 0; k < grid.samples; ++k) {
          const PatchSample other = neighbours.across({p, side}, k);
          ASSERT_EQ(other.exists(), grid.adjacency[p][side].patch >= 0);
          if (!other.exists()) continue;
          EXPECT_EQ(place_of(grid, other), place_of(grid, neighbours.on_side({p, side}, k)));
          EXPECT_EQ(neighbours.across({p, side}, k, 1),
                    neighbours.on_side(grid.adjacency[p][side], grid.samples - 1 - k, 1));
        }
      }
    }
  }
}

TEST(PatchNeighbours, TheRingIsTheFanOfTrianglesAroundTheSample) {
  for (const Grid& grid : grids()) {
    const PatchNeighbours neighbours(grid.samples, grid.adjacency);
    // [place] the pairs (next corner, last corner) of the triangles around it.
    std::map<Place, std::set<std::pair<Place, Place>>> fans;
    for (std::int32_t p = 0; p < static_cast<std::int32_t>(grid.places.size()); ++p) {
      for_each_patch_triangle(grid.samples, !grid.places[p].right.exists(), [&](const auto&... corner) {
        const std::array<Place, 3> at{place_of(grid, {p, corner[0], corner[1]})...};
        for (int c = 0; c < 3; ++c) fans[at[c]].insert({at[(c + 1) % 3], at[(c + 2) % 3]});
      });
    }
    for_each_sample(grid, neighbours, [&](const PatchSample& s) {
      const SampleRing ring = neighbours.ring(s);
      std::set<std::pair<Place, Place>> walked;
      const std::size_t count = ring.samples.size();
      for (std::size_t n = 0; n + (ring.closed ? 0 : 1) < count; ++n) {
        walked.insert({place_of(grid, ring.samples[n]), place_of(grid, ring.samples[(n + 1) % count])});
      }
      EXPECT_EQ(walked, fans[place_of(grid, s)])
          << "sample " << s.i << ", " << s.j << " of patch " << s.patch << ", N = " << grid.samples;
      EXPECT_EQ(walked.size(), count - (ring.closed ? 0 : 1));
    });
  }
}

TEST(PatchPlaces, OfADomainHaveNoDefectAndEveryChangeIsOne) {
  for (const Domain& domain : domains()) {
    const std::vector<PatchPlace> places = patch_places(domain);
    EXPECT_EQ(find_place_defect(places), std::nullopt);
    for (std::size_t p = 0; p < places.size(); ++p) {
      const auto refused = [&](auto change) {
        std::vector<PatchPlace> broken = places;
        change(broken[p]);
        return find_place_defect(broken).has_value();
      };
      EXPECT_TRUE(refused([](PatchPlace& q) { q.a = -1; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.a = q.b; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { std::swap(q.a, q.b); }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.b += 100; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.left.side = 3; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.left.triangle = 1 << 30; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.left.triangle = -7; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.right = q.left; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.right.side = (q.right.side + 1) % 3; }));
      EXPECT_TRUE(refused([](PatchPlace& q) { q.left = {}; }));
    }
    std::vector<PatchPlace> fewer = places;
    fewer.pop_back();
    EXPECT_TRUE(find_place_defect(fewer).has_value());
  }
}

}  // namespace
}  // namespace lozenge
