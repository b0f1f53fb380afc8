// Surfaces that end: whatever is done to map and domain, their boundaries stay on each other.
#include "stages/parameterize/map/boundary.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/domain/open_fixtures.h"
#include "formats/surface/boundary.h"
#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/levels/simplify.h"
#include "stages/parameterize/levels/split_long_edges.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/operations/can_collapse.h"
#include "stages/parameterize/operations/collapse.h"
#include "stages/parameterize/operations/flip.h"
#include "stages/parameterize/operations/split.h"
#include "stages/parameterize/operations/warm_up.h"
#include "stages/parameterize/parameterize.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

double flat(const Vec3d&) { return 0; }

std::size_t loops_of(const std::vector<std::array<VertexId, 3>>& triangles) {
  return boundary_loops(boundary_sides(triangles)).size();
}

std::size_t loops_of(const Domain& domain) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const DomainTriangle& t : domain.triangles) triangles.push_back(t.corners);
  return loops_of(triangles);
}

/// Disks, bands, and closed surfaces with ragged holes; without edges through the inside between boundary vertices.
std::vector<SourceMesh> open_surfaces() {
  std::vector<SourceMesh> surfaces{test::sheet(14, [](const Vec3d& p) { return 0.1 * p.x * p.y; }),
                                   test::band(40, 12, 1.2), test::band(90, 4, 0.3)};
  for (unsigned seed = 0; seed < 4; ++seed) {
    surfaces.push_back(
        test::opened(test::sphere(9, test::random_relief(0.3, seed)), 1 + static_cast<int>(seed), 0.45, seed));
  }
  surfaces.push_back(test::opened(test::torus(24, 12, 0.4, [](double, double) { return 0.0; }), 3, 0.35, 7));
  for (SourceMesh& mesh : surfaces) mesh = split_chords(mesh);
  return surfaces;
}

HalfedgeMesh halfedges_of(const SourceMesh& mesh) {
  return make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
}

DomainSide random_side(const WorkingMap& map, std::mt19937& random) {
  for (;;) {
    const DomainSide side{static_cast<DomainTriangleId>(random() % map.domain.triangles.size()),
                          static_cast<std::int32_t>(random() % 3)};
    if (map.domain.corner(side.triangle, 0) >= 0) return side;
  }
}

TEST(SplitChords, LeavesNoEdgeThroughTheInsideBetweenBoundaryVertices) {
  for (const SourceMesh& mesh : open_surfaces()) {
    EXPECT_FALSE(has_chord(halfedges_of(mesh)));
  }
  EXPECT_TRUE(has_chord(halfedges_of(test::sheet(2, flat))));
  EXPECT_FALSE(has_chord(halfedges_of(test::sphere(3, flat))));
  EXPECT_EQ(split_chords(test::sheet(1, flat)).triangles.size(), 4U);
}

TEST(Simplify, KeepsBoundariesAndMakesNoEdgeThroughTheInsideBetweenThem) {
  for (const SourceMesh& mesh : open_surfaces()) {
    const HalfedgeMesh before = halfedges_of(mesh);
    HalfedgeMesh simplified = before;
    RemovalGuard guard;
    guard.removed = [&](const Removal&) {
      for (VertexId v = 0; v < simplified.vertex_count(); ++v) {
        if (simplified.outgoing[v] < 0) continue;
        EXPECT_EQ(simplified.start(simplified.outgoing[v]), v);
        if (!simplified.on_boundary(v)) continue;
        for_each_outgoing(simplified, v, [&](Halfedge h) {
          EXPECT_TRUE(simplified.twins[h] < 0 || !simplified.on_boundary(simplified.end(h)));
        });
      }
      return true;
    };
    const std::vector<Removal> removals = simplify(simplified, mesh.positions, 0, guard);
    EXPECT_GT(removals.size(), before.outgoing.size() / 4);
    std::vector<std::array<VertexId, 3>> left;
    for (const auto& t : simplified.triangles) {
      if (t[0] >= 0) left.push_back(t);
    }
    EXPECT_EQ(loops_of(left), loops_of(mesh.triangles));
    for (auto r = removals.rbegin(); r != removals.rend(); ++r) undo_removal(simplified, *r);
    EXPECT_EQ(simplified.triangles, before.triangles);
    EXPECT_EQ(simplified.twins, before.twins);
    for (VertexId v = 0; v < simplified.vertex_count(); ++v) {
      EXPECT_EQ(simplified.on_boundary(v), before.on_boundary(v));
    }
  }
}

TEST(Collapse, KeepsTheDomainsBoundaryUnderTheSurfaces) {
  std::mt19937 random(3);
  for (const SourceMesh& mesh : open_surfaces()) {
    WorkingMap map = trivial_map(mesh.positions, halfedges_of(mesh));
    Scratch scratch;
    SurfaceMeasures measures = trivial_measures(map);
    const std::size_t loops = loops_of(mesh.triangles);
    const std::int32_t euler = euler_characteristic(map.domain);
    int done = 0;
    for (int attempt = 0; attempt < 1200 && map.domain_faces > 24; ++attempt) {
      const DomainSide side = random_side(map, random);
      if (!can_collapse(map, side)) continue;
      const int faces = map.domain_faces;
      const int gone = map.domain.neighbour(side).exists() ? 2 : 1;
      const bool collapsed = collapse(map, measures, side, {}, scratch).has_value();
      EXPECT_EQ(map.domain_faces, collapsed ? faces - gone : faces);
      if (collapsed && ++done % 20 == 0) test::expect_sound(map);
    }
    EXPECT_GT(done, 20);
    test::expect_sound(map);
    const Domain domain = finished(map).domain;
    EXPECT_EQ(euler_characteristic(domain), euler);
    EXPECT_EQ(loops_of(domain), loops);
  }
}

TEST(FlipAndSplit, KeepTheDomainsBoundaryUnderTheSurfaces) {
  std::mt19937 random(4);
  int which = 0;
  for (const SourceMesh& mesh : open_surfaces()) {
    SCOPED_TRACE(which++);
    WorkingMap map = test::decimated_map(mesh, 40);
    Scratch scratch;
    test::expect_sound(map);
    const std::size_t loops = loops_of(mesh.triangles);
    for (int attempt = 0; attempt < 60; ++attempt) {
      const DomainSide side = random_side(map, random);
      if (attempt % 3 == 0 && can_split(map, side)) {
        split(map, side, {3, 1e-2}, scratch);
      } else if (can_flip(map, side)) {
        flip(map, side, {3, 1e-2}, scratch);
      }
      for (DomainVertex n = 0; attempt % 10 == 0 && n < static_cast<DomainVertex>(map.corner_of.size()); ++n) {
        if (map.corner_of[n].triangle >= 0 && !valence(map, n).is_regular()) crawl(map, n, scratch);
      }
      test::expect_sound(map);
      ASSERT_FALSE(HasFailure()) << "after attempt " << attempt;
    }
    EXPECT_EQ(loops_of(finished(map).domain), loops);
  }
}

TEST(Refine, PutsTheVerticesOfTheBoundaryBackOnIt) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    SourceMesh mesh = test::opened(test::sphere(24, test::random_relief(0.3, 40 + seed)), 3, 0.35, seed);
    mesh = split_chords(mesh);
    std::vector<Removal> removals;
    WorkingMap map = test::decimated_map(mesh, 40, &removals);
    EXPECT_GT(removals.size(), 500U);
    ASSERT_TRUE(refine(map, std::move(removals), {1.5, 2}, {}));
    EXPECT_EQ(map.mesh.triangles, mesh.triangles);
    test::expect_whole(map, mesh);
  }
}

TEST(WorkingMap, TakesFinishedMapsOfOpenSurfacesAndGoesOn) {
  for (const fixtures::OpenSurface& open : fixtures::open_surfaces()) {
    const WorkingMap map = working_map(open.mesh, open.map);
    test::expect_sound(map);
  }
}

void expect_guarantees(const ParameterizeResult& made, const SourceMesh& source) {
  EXPECT_EQ(find_defect(made.map.domain), std::nullopt);
  EXPECT_EQ(loops_of(made.map.domain), loops_of(source.triangles));
  const Distortion d = measure_distortion(made.surface, made.map);
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
  for (std::size_t i = 1; i < made.energies.size(); ++i) EXPECT_LE(made.energies[i], made.energies[i - 1] + 1e-12);
}

TEST(Parameterize, MapsOpenSurfacesWithoutAFold) {
  ParameterizeOptions options;
  options.min_domain_faces = 40;
  options.max_domain_faces = 60;
  for (const SourceMesh& mesh : open_surfaces()) {
    const ParameterizeResult made = parameterize(mesh, options, {});
    expect_guarantees(made, mesh);
    EXPECT_LE(made.map.domain.size(), 60);
    EXPECT_LT(made.distortion.aggregate, 0.3);
  }
}

TEST(Parameterize, MapsAFlatSquareWithHardlyAnyDistortion) {
  ParameterizeOptions options;
  options.min_domain_faces = 40;
  options.max_domain_faces = 80;
  const SourceMesh mesh = test::sheet(24, flat);
  const ParameterizeResult made = parameterize(mesh, options, {});
  expect_guarantees(made, mesh);
  EXPECT_LT(made.distortion.aggregate, 0.03);
}

TEST(Parameterize, TakesTheSmallestOpenSurfaces) {
  SourceMesh triangle;
  triangle.origin = "triangle";
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0.3F, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  const SourceMesh square = test::sheet(1, flat);
  const SourceMesh ring = test::band(3, 1, 1);
  const SourceMesh all =
      test::beside(test::beside(triangle, square, 3), test::beside(ring, test::sphere(6, flat), 6), 6);
  for (const double longest_edge : {0.0, 0.4}) {
    ParameterizeOptions options;
    options.longest_edge = longest_edge;
    options.min_domain_faces = 4;
    options.max_domain_faces = 20;
    for (const SourceMesh& mesh : {triangle, square, ring, all})
      expect_guarantees(parameterize(mesh, options, {}), mesh);
  }
}

}  // namespace
}  // namespace lozenge
