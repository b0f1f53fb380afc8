#include "stages/parameterize/parameterize.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <set>

#include "formats/base/error.h"
#include "stages/parameterize/levels/coarsen.h"
#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/map/consistency.h"
#include "stages/parameterize/map_fixtures.h"
#include "stages/parameterize/parts.h"
#include "stages/parameterize/surface_fixtures.h"

namespace lozenge {
namespace {

double flat(double, double) { return 0; }

void expect_guarantees(const ParameterizeResult& made, int euler) {
  EXPECT_EQ(find_defect(made.map.domain), std::nullopt);
  EXPECT_EQ(euler_characteristic(made.map.domain), euler);
  const Distortion d = measure_distortion(made.surface, made.map);
  EXPECT_EQ(d.folded_triangles, 0);
  EXPECT_EQ(d.area_sum_error, 0);
  EXPECT_EQ(d.aggregate, made.distortion.aggregate);
  for (std::size_t i = 1; i < made.energies.size(); ++i) EXPECT_LE(made.energies[i], made.energies[i - 1] + 1e-12);
}

TEST(Parameterize, ShowsAFaultAtOnceInsteadOfTryingAgain) {
  const SourceMesh mesh = test::sphere(10, test::random_relief(0.2, 3));
  int searches = 0;
  const Progress planted = [&](std::string_view what, double) {
    if (what != "optimizing the map") return;
    ++searches;
    throw Error(ExitCode::kInternal, "planted");
  };
  try {
    parameterize(mesh, {}, planted);
    FAIL() << "the fault was swallowed";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "planted");
  }
  EXPECT_EQ(searches, 1);
}

TEST(Parameterize, MapsRandomReliefsWithoutAFold) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    ParameterizeOptions options;
    options.min_domain_faces = 40 + 10 * static_cast<int>(seed);
    options.max_domain_faces = options.min_domain_faces + 10;
    const auto made = parameterize(test::sphere(14, test::random_relief(0.35, seed)), options, {});
    expect_guarantees(made, 2);
    EXPECT_GE(made.map.domain.size(), options.min_domain_faces);
    EXPECT_LE(made.map.domain.size(), options.max_domain_faces);
    EXPECT_LT(made.distortion.aggregate, 0.25);
  }
}

/// Triangles of which each has a third cut off again and again at its longest side: needles, each three times as flat
/// as the one before.
SourceMesh with_needles(SourceMesh mesh, std::size_t count, int times) {
  const std::size_t apart = mesh.triangles.size() / count;
  for (std::size_t k = 0; k < count; ++k) {
    for (int i = 0; i < times; ++i) {
      const auto [a, b, c] = mesh.triangles[k * apart];
      const auto centre = static_cast<VertexId>(mesh.positions.size());
      mesh.positions.push_back((mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3);
      mesh.triangles[k * apart] = {a, b, centre};
      mesh.triangles.push_back({b, c, centre});
      mesh.triangles.push_back({c, a, centre});
    }
  }
  return mesh;
}

TEST(Parameterize, IsNotHeldUpByNeedles) {
  ParameterizeOptions options;
  options.min_domain_faces = 40;
  options.max_domain_faces = 50;
  for (unsigned seed = 0; seed < 3; ++seed) {
    const SourceMesh mesh = test::sphere(14, test::random_relief(0.35, seed));
    const auto made = parameterize(with_needles(mesh, 60, 8), options, {});
    expect_guarantees(made, 2);
    EXPECT_LT(made.distortion.aggregate, 2 * parameterize(mesh, options, {}).distortion.aggregate);
  }
}

TEST(Parameterize, KeepsTheGenusAndTheComponents) {
  ParameterizeOptions options;
  options.min_domain_faces = 50;
  options.max_domain_faces = 60;
  const SourceMesh torus = test::torus(30, 16, 0.4, flat);
  expect_guarantees(parameterize(torus, options, {}), 0);
  expect_guarantees(parameterize(test::beside(torus, test::sphere(8, test::random_relief(0.2, 9)), 5), options, {}), 2);
}

SourceMesh scaled(SourceMesh mesh, double size) {
  for (Vec3f& p : mesh.positions) p *= static_cast<float>(size);
  return mesh;
}

/// The domain triangles that a part has for its area, at its scale, by one of its triangles: [part]
std::vector<double> densities(const ParameterizeResult& made) {
  std::vector<double> found;
  for (const Part& part : split_into_parts(made.surface)) {
    std::set<DomainTriangleId> waiting;
    std::set<DomainTriangleId> seen;
    for (const VertexId v : part.vertices) waiting.insert(made.map.phi[v].triangle);
    double size = 0;
    while (!waiting.empty()) {
      const DomainTriangleId t = *waiting.begin();
      waiting.erase(waiting.begin());
      if (!seen.insert(t).second) continue;
      size += area_at_level(made.map.first_level(t));
      for (const DomainSide& side : made.map.domain.triangles[t].neighbours) {
        if (side.exists()) waiting.insert(side.triangle);
      }
    }
    found.push_back(size / part.area);
  }
  return found;
}

TEST(Parameterize, GivesPartsOfAnySizeTheSameDensityByScalesOfTheirOwn) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    SourceMesh mesh = test::sphere(10, test::random_relief(0.2, seed));
    for (const double size : {0.6, 0.3, 0.12, 0.05}) {
      mesh = test::beside(mesh, scaled(test::sphere(6, test::random_relief(0.2, seed)), size), 3 + 3 * size);
    }
    const auto made = parameterize(mesh, {}, {});
    expect_guarantees(made, 10);
    EXPECT_EQ(find_first_level_defect(made.map.domain, made.map.first_levels), std::nullopt);
    EXPECT_GT(made.map.first_levels.back(), 1);
    const std::vector<double> all = densities(made);
    ASSERT_EQ(all.size(), 5U);
    // Whole, even numbers of triangles, from 4 on; and a twentieth of room for the search.
    EXPECT_LT(*std::max_element(all.begin(), all.end()), 1.9 * *std::min_element(all.begin(), all.end()));
    EXPECT_LT(made.distortion.area, 0.1);
  }
}

SourceMesh box(double x, double y, double z) {
  SourceMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(Vec3f(Vec3d((i & 1) * x, (i >> 1 & 1) * y, (i >> 2) * z)));
  mesh.triangles = {{0, 2, 3}, {3, 1, 0}, {4, 5, 7}, {7, 6, 4}, {0, 1, 5}, {5, 4, 0},
                    {2, 6, 7}, {7, 3, 2}, {0, 4, 6}, {6, 2, 0}, {1, 3, 7}, {7, 5, 1}};
  return mesh;
}

TEST(Parameterize, LeavesBoxesTheirTwelveTriangles) {
  const auto alone = parameterize(box(1, 2, 5), {}, {});
  expect_guarantees(alone, 2);
  EXPECT_EQ(alone.map.domain.size(), 4);
  EXPECT_EQ(alone.surface.triangles.size(), 12U);

  SourceMesh many = test::sphere(14, test::random_relief(0.2, 5));
  const std::size_t others = many.triangles.size();
  for (int i = 0; i < 20; ++i) many = test::beside(many, box(0.1 * (1 + i % 4), 0.1 * (1 + i % 3), 0.2), 3 + i);
  const auto made = parameterize(many, {}, {});
  expect_guarantees(made, 42);
  EXPECT_EQ(made.parts_as_they_are, 20);
  std::size_t boxes = 0;
  for (const Part& part : split_into_parts(made.surface)) boxes += part.mesh.triangles.size() == 12;
  EXPECT_EQ(boxes, 20U);
  EXPECT_GE(made.surface.triangles.size(), others + 240);
}

TEST(Parameterize, MapsPartsOfAFewTrianglesToThemselves) {
  const auto quad = parameterize(test::sheet(1, [](const Vec3d&) { return 0.0; }), {}, {});
  expect_guarantees(quad, 1);
  EXPECT_EQ(quad.map.domain.size(), 2);
  EXPECT_EQ(quad.surface.triangles.size(), 2U);
}

TEST(Parameterize, GivesTheSourceBackHardlySplit) {
  // 100 to 200 domain triangles split each of its edges twice while the map is looked for.
  ParameterizeOptions options;
  options.min_domain_faces = 60;
  options.max_domain_faces = 80;
  const SourceMesh mesh = test::sphere(9, test::random_relief(0.2, 4));
  const auto made = parameterize(mesh, options, {});
  expect_guarantees(made, 2);
  EXPECT_LT(made.surface.triangles.size(), mesh.triangles.size() * 5 / 2);
  EXPECT_TRUE(made.surface.corner_attributes.empty());
}

TEST(Parameterize, GivesASphereTheDomainOfAnOctahedronOrAnIcosahedron) {
  ParameterizeOptions options;
  options.min_domain_faces = 4;
  options.max_domain_faces = 24;
  const auto made = parameterize(test::sphere(20, [](const Vec3d&) { return 0.0; }), options, {});
  expect_guarantees(made, 2);
  const int faces = made.map.domain.size();
  ASSERT_TRUE(faces == 8 || faces == 20) << faces;
  for (const int k : valences(made.map.domain)) EXPECT_EQ(k, faces == 8 ? 4 : 5);
}

TEST(Parameterize, TakesNoMoreDomainTrianglesThanTheSurfaceHas) {
  const auto made = parameterize(test::sphere(1, [](const Vec3d&) { return 0.0; }), {}, {});
  expect_guarantees(made, 2);
  EXPECT_LE(made.map.domain.size(), static_cast<int>(made.surface.triangles.size()));
}

TEST(Parameterize, IsTheSameOnEachRunAndAnyNumberOfThreads) {
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.3, 11));
  ParameterizeOptions options;
  options.min_domain_faces = 30;
  options.max_domain_faces = 40;
  const auto first = parameterize(mesh, options, {});
  for (const int threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    const auto again = parameterize(mesh, options, {});
    EXPECT_TRUE(again.map.phi == first.map.phi);
    EXPECT_EQ(again.map.domain.size(), first.map.domain.size());
  }
}

TEST(Parameterize, HoldsItsGuaranteesUnderEveryOption) {
  const SourceMesh mesh = test::sphere(12, test::random_relief(0.3, 13));
  ParameterizeOptions options;
  options.min_domain_faces = 30;
  options.max_domain_faces = 40;
  for (const EnergyKind energy : {EnergyKind::kMips, EnergyKind::kSymmetricDirichlet}) {
    options.energy = energy;
    expect_guarantees(parameterize(mesh, options, {}), 2);
  }
  options.energy = EnergyKind::kIsometric;
  options.gamma = 1;
  expect_guarantees(parameterize(mesh, options, {}), 2);
  options.gamma = 3;
  options.star_conformality = 0.5;
  expect_guarantees(parameterize(mesh, options, {}), 2);
  options.partitions_in_turn = true;
  expect_guarantees(parameterize(mesh, options, {}), 2);
  options.proxy_triangles_per_face = 0;
  expect_guarantees(parameterize(mesh, options, {}), 2);
}

TEST(Parameterize, DoesNotCareForTheSurfacesSizeAndPlace) {
  ParameterizeOptions options;
  options.min_domain_faces = 30;
  options.max_domain_faces = 40;
  for (const float scale : {1e-6F, 1e6F}) {
    SourceMesh mesh = test::sphere(12, test::random_relief(0.3, 15));
    for (Vec3f& p : mesh.positions) p *= scale;
    const auto made = parameterize(mesh, options, {});
    expect_guarantees(made, 2);
    EXPECT_LT(made.distortion.aggregate, 0.2);
  }
}

TEST(Parameterize, RefusesOptionsWithoutSense) {
  const SourceMesh mesh = test::sphere(2, [](const Vec3d&) { return 0.0; });
  const auto code_of = [&](const ParameterizeOptions& options) {
    try {
      parameterize(mesh, options, {});
    } catch (const Error& e) {
      return e.code();
    }
    return ExitCode::kDone;
  };
  ParameterizeOptions options;
  options.min_domain_faces = 3;
  EXPECT_EQ(code_of(options), ExitCode::kUsage);
  options = {};
  options.max_domain_faces = 50;
  EXPECT_EQ(code_of(options), ExitCode::kUsage);
  options = {};
  options.gamma = -1;
  EXPECT_EQ(code_of(options), ExitCode::kUsage);
  options = {};
  options.star_conformality = 2;
  EXPECT_EQ(code_of(options), ExitCode::kUsage);
}

TEST(Refine, PutsEveryVertexBackWithoutAFoldAfterEachLevel) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const SourceMesh mesh = test::sphere(24, test::random_relief(0.3, 20 + seed));
    std::vector<Removal> removals;
    WorkingMap map = test::decimated_map(mesh, 40, &removals);
    EXPECT_GT(removals.size(), 1000U);
    ASSERT_TRUE(refine(map, std::move(removals), {1.5, 2}, {}));
    EXPECT_EQ(map.mesh.triangles, mesh.triangles);
    test::expect_whole(map, mesh);
  }
}

TEST(Coarsen, TakesVerticesOutFromUnderTheMapAndRefineBringsThemBack) {
  const SourceMesh mesh = test::sphere(16, test::random_relief(0.3, 31));
  WorkingMap map = test::decimated_map(mesh, 40);
  std::vector<Removal> removals = coarsen(map, 900);
  EXPECT_GT(removals.size(), 100U);
  test::expect_sound_domain(map);
  for (VertexId v = 0; v < map.mesh.vertex_count(); ++v) {
    EXPECT_TRUE(map.mesh.outgoing[v] < 0 || is_sound(map, v));
  }
  ASSERT_TRUE(refine(map, std::move(removals), {}, {}));
  EXPECT_EQ(map.mesh.triangles, mesh.triangles);
  test::expect_whole(map, mesh);
}

TEST(Parameterize, MapsASurfaceToItselfAtOnceWhereTheSearchIsStuckFarAboveWhatIsAsked) {
  // Cones hold the search as needles do that no domain of fewer triangles has room for.
  const SourceMesh mesh = test::torus(20, 8, 0.4, flat);
  ParameterizeOptions options;
  options.min_domain_faces = 4;
  options.max_domain_faces = 8;
  for (VertexId v = 0; v < static_cast<VertexId>(mesh.positions.size()); ++v) {
    if (v % 10 != 0) options.cones.push_back(v);
  }
  int attempts = 0;
  const auto made =
      parameterize(mesh, options, [&](std::string_view what, double) { attempts += what == "simplifying"; });
  expect_guarantees(made, 0);
  EXPECT_EQ(made.map.domain.size(), static_cast<int>(mesh.triangles.size()));
  EXPECT_EQ(attempts, 1);
}

TEST(Parameterize, KeepsTheUsersConesAtDomainVerticesOfAnyValence) {
  const SourceMesh mesh = test::sphere(16, test::random_relief(0.3, 8));
  ParameterizeOptions options;
  options.min_domain_faces = options.max_domain_faces = 60;
  options.longest_edge = 0;  // vertices keep their numbers
  options.cones = {3, 250, 251, 700, 3};
  const ParameterizeResult result = parameterize(mesh, options, {});
  EXPECT_EQ(result.distortion.folded_triangles, 0);
  for (const VertexId cone : options.cones) {
    EXPECT_GE(vertex_at(result.map.domain, result.map.phi[cone]), 0) << "vertex " << cone;
  }
  options.cones = {static_cast<VertexId>(mesh.positions.size())};
  EXPECT_THROW(parameterize(mesh, options, {}), Error);
}

TEST(Parameterize, KeepsConesOfAMeshThatItNumbersAnew) {
  // 105,800 triangles: numbered along a curve first, so vertices are found again by where they are.
  const SourceMesh mesh = test::sphere(115, test::random_relief(0.2, 4));
  ParameterizeOptions options;
  options.cones = {0, 17'000, 52'000};
  const auto made = parameterize(mesh, options, {});
  expect_guarantees(made, 2);
  EXPECT_NE(made.surface.triangles, mesh.triangles);
  for (const VertexId cone : options.cones) {
    const auto& positions = made.surface.positions;
    const auto at = std::find(positions.begin(), positions.end(), mesh.positions[cone]);
    ASSERT_NE(at, positions.end());
    EXPECT_GE(vertex_at(made.map.domain, made.map.phi[at - positions.begin()]), 0) << "vertex " << cone;
  }
}

}  // namespace
}  // namespace lozenge
