#include "stages/sample/boundary_corners.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/domain/open_fixtures.h"

namespace lozenge {
namespace {

/// One domain triangle with 8 source triangles a side; a vertex of its first side is pulled out to a spike.
struct Spiked {
  fixtures::OpenSurface open = fixtures::triangle(8);
  VertexId spike = -1;
  DomainSide side;

  Spiked() {
    for (VertexId v = 0; v < static_cast<VertexId>(open.mesh.positions.size()) && spike < 0; ++v) {
      const auto place = place_on_boundary(open.map.domain, open.map.phi[v]);
      if (!place || place->along < 0.3 || place->along > 0.45) continue;
      spike = v;
      side = place->side;
    }
    open.mesh.positions[spike] += Vec3f(0, 0, 0.5F);
  }
};

TEST(BoundaryCorners, DrawTheSampleBesideASpikeIntoIt) {
  const Spiked spiked;
  ASSERT_GE(spiked.spike, 0);
  const BoundaryCorners corners(spiked.open.mesh, spiked.open.map);
  const std::vector<double> along{0, 0.25, 0.5, 0.75, 1};
  std::vector<Vec3f> regular(5, Vec3f(0, 0, 0));
  for (std::size_t k = 0; k < 5; ++k) regular[k].x = static_cast<float>(along[k]);
  const auto places = corners.places(spiked.side, along, regular);
  ASSERT_EQ(places.size(), 5U);
  EXPECT_FALSE(places.front() || places.back());
  const Vec3f spike = spiked.open.mesh.positions[spiked.spike];
  EXPECT_TRUE(std::any_of(places.begin(), places.end(),
                          [&](const auto& p) { return p && position_at(spiked.open.mesh, *p) == spike; }));
}

TEST(BoundaryCorners, KeepTheOrderAlongTheBoundary) {
  const Spiked spiked;
  const BoundaryCorners corners(spiked.open.mesh, spiked.open.map);
  std::vector<double> along;
  std::vector<Vec3f> regular;
  for (int k = 0; k <= 16; ++k) {
    along.push_back(k / 16.0);
    regular.emplace_back(static_cast<float>(k), 0.0F, 0.0F);
  }
  const auto places = corners.places(spiked.side, along, regular);
  double before = -1;
  for (std::size_t k = 0; k < places.size(); ++k) {
    double here = along[k];
    if (places[k]) {
      const auto& weights = places[k]->weights;
      const int c = static_cast<int>(std::max_element(&weights.x, &weights.x + 3) - &weights.x);
      here = place_on_boundary(spiked.open.map.domain,
                               spiked.open.map.phi[spiked.open.mesh.triangles[places[k]->triangle][c]])
                 ->along;
    }
    EXPECT_GT(here, before);
    before = here;
  }
}

TEST(PlaceOnBoundary, KnowsSidesFromInsidesAndCorners) {
  const Domain domain = fixtures::triangle(2).map.domain;
  EXPECT_EQ(place_on_boundary(domain, make_point(0, 0.25, 0.75))->along, 0.75);
  EXPECT_FALSE(place_on_boundary(domain, make_point(0, 0.25, 0.5)));
  EXPECT_FALSE(place_on_boundary(domain, corner_point({0, 1})));
}

}  // namespace
}  // namespace lozenge
