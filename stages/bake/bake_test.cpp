#include "stages/bake/bake.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/base/error.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/patch_neighbours.h"
#include "formats/patches/tangent_frame.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;

struct Case {
  SourceMesh mesh;
  Parameterization map;
  GeometryImage image;
};

/// A sphere; `bumps` is the height of the hills on the source alone, which the geometry image doesn't have.
Case sphere(const Domain& base, double bumps = 0, int n = 24) {
  auto [mesh, map] = fixtures::subdivided_sphere(base, n);
  for (Vec3f& p : mesh.positions) {
    const Vec3d d(p);
    p *= static_cast<float>(1 + bumps * std::sin(5 * d.x) * std::sin(4 * d.y + 1) * std::sin(6 * d.z));
  }
  return {std::move(mesh), std::move(map), fixtures::sphere_image(base, 3)};
}

std::vector<Case> cases() {
  std::vector<Case> result{sphere(fixtures::octahedron()), sphere(fixtures::icosahedron(), 0.02)};
  // A jittered map: its correspondence wobbles about, rays don't.
  result.push_back(sphere(fixtures::icosahedron(), 0.02));
  fixtures::jitter(result.back().map, 0.01, 5);
  return result;
}

BakeOptions small(std::vector<MapKind> maps) {
  BakeOptions options;
  options.maps = std::move(maps);
  options.size = 320;
  options.occlusion_size = 80;
  return options;
}

Vec3d texel(const BakedMap& map, std::int32_t x, std::int32_t y) {
  const float* t = &map.texels[(static_cast<std::size_t>(y) * map.width() + x) * map.channels];
  return {t[0], t[1], t[2]};
}

/// Texel (i, j) of a patch, from its inner corner; negative in the gutter.
Vec3d tile_texel(const BakedMap& map, std::int32_t patch, std::int32_t i, std::int32_t j) {
  const MapTile tile = map.layout.tile_of(patch);
  return texel(map, tile.x + tile.gutter + i, tile.y + tile.gutter + j);
}

/// What a renderer's bilinear lookup gives.
Vec3d lookup(const BakedMap& map, const Vec2d& texcoord) {
  const double x = texcoord.x * map.width() - 0.5;
  const double y = texcoord.y * map.height() - 0.5;
  const auto i = static_cast<std::int32_t>(std::floor(x));
  const auto j = static_cast<std::int32_t>(std::floor(y));
  const double s = x - i;
  const double t = y - j;
  return (texel(map, i, j) * (1 - s) + texel(map, i + 1, j) * s) * (1 - t) +
         (texel(map, i, j + 1) * (1 - s) + texel(map, i + 1, j + 1) * s) * t;
}

/// What a renderer knows about a fragment.
struct Fragment {
  Vec3d position{0, 0, 0};
  ShadingFrame frame;
  Vec2d texcoord{0, 0};
};

/// A random point of the level's surface.
Fragment random_fragment(const GeometryImage& image, int level_number, const MapLayout& layout,
                         const FrameVertices& frames, std::mt19937& random) {
  const GeometryLevel& level = image.levels[level_number];
  std::uniform_real_distribution<double> number(0, 1);
  const auto p = static_cast<std::int32_t>(number(random) * image.size());
  const auto i = static_cast<std::int32_t>(number(random) * (level.samples - 1));
  const auto j = static_cast<std::int32_t>(number(random) * (level.samples - 1));
  std::array<std::array<std::int32_t, 2>, 3> corners{{{i, j}, {i + 1, j}, {i, j + 1}}};
  if (number(random) < 0.5) corners = {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
  const double a = std::sqrt(number(random));
  const double b = number(random);
  const Vec3d w(1 - a, a * (1 - b), a * b);
  Fragment fragment;
  std::array<const FrameVertex*, 3> vertices{};
  for (int c = 0; c < 3; ++c) {
    vertices[c] = &frames.at(p, corners[c][0], corners[c][1]);
    fragment.position += Vec3d(level.positions[image.index(level, p, corners[c][0], corners[c][1])]) * w[c];
    fragment.texcoord += Vec2d(vertices[c]->texcoord) * w[c];
  }
  fragment.frame = shading_frame(vertices, w);
  EXPECT_LT(fragment.texcoord.x, 1.0 * layout.columns * layout.tile / layout.width);
  return fragment;
}

double angle(const Vec3d& a, const Vec3d& b) { return std::atan2(a.cross(b).length(), a.dot(b)); }

TEST(Bake, GivesTheSpheresObjectNormals) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    const Case c = sphere(base, 0, 32);
    const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal, MapKind::kPosition}));
    const BakedMap& normals = *maps.find(MapKind::kObjectNormal);
    const BakedMap& positions = *maps.find(MapKind::kPosition);
    double worst = 0;
    for (std::int32_t p = 0; p < c.image.size(); ++p) {
      for (std::int32_t k = 0; k < normals.layout.tile * normals.layout.tile; ++k) {
        const std::int32_t i = k % normals.layout.tile - normals.layout.gutter_of(normals.layout.tile);
        const std::int32_t j = k / normals.layout.tile - normals.layout.gutter_of(normals.layout.tile);
        const Vec3d n = tile_texel(normals, p, i, j);
        ASSERT_NEAR(n.length(), 1, 1e-6);
        worst = std::max(worst, angle(n, tile_texel(positions, p, i, j)));
      }
    }
    // Rays leave along the level's interpolated normals, the correspondence is the fixture's own: the two differ by the
    // level's curvature between samples, most so for the tetrahedron's large faces.
    EXPECT_LT(worst, (base.size() == 4 ? 3 : 1.5) * kDegree);
  }
}

TEST(Bake, GivesARendererTheSourcesNormals) {
  for (const Case& c : cases()) {
    for (const int level : {0, 1}) {
      BakeOptions options = small({MapKind::kTangentNormal});
      options.size = 640;
      options.level = level;
      const BakedMaps maps = bake(c.mesh, c.map, c.image, options);
      const BakedMap& map = maps.maps[0];
      EXPECT_EQ(maps.level, level);
      EXPECT_EQ(map.level, level);
      const FrameVertices frames = frame_vertices(c.image, level, map.layout);
      const RayScene scene(c.mesh.positions, c.mesh.triangles);
      const ShadingNormals source_normals(c.mesh);
      std::mt19937 random(6);
      double sum = 0;
      constexpr int kPoints = 4000;
      for (int k = 0; k < kPoints; ++k) {
        const Fragment fragment = random_fragment(c.image, level, map.layout, frames, random);
        const Vec3d& n = fragment.frame.normal;
        const RayHit hit = scene.closest_hit({fragment.position + n * 0.2, -n});
        ASSERT_TRUE(hit.exists());
        const Vec3d expected(source_normals.at(hit.triangle, hit.weights));
        const double off = angle(fragment.frame.to_object(lookup(map, fragment.texcoord)), expected);
        EXPECT_LT(off, 2 * kDegree);
        sum += off;
      }
      EXPECT_LT(sum / kPoints, 0.2 * kDegree);
    }
  }
}

TEST(Bake, TangentNormalsAreFlatOnASphereThatItsOwnNormalsShadeWell) {
  const Case c = sphere(fixtures::icosahedron());
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kTangentNormal}));
  const BakedMap& map = maps.maps[0];
  // Not so in the gutters, which show the neighbours' normals in the patch's own frame.
  const std::int32_t inner = map.layout.inner();
  for (std::int32_t p = 0; p < c.image.size(); ++p) {
    for (std::int32_t k = 0; k < inner * inner; ++k) {
      EXPECT_LT(angle(tile_texel(map, p, k % inner, k / inner), {0, 0, 1}), 1 * kDegree);
    }
  }
}

TEST(Bake, ContinuesEveryPatchIntoItsNeighbours) {
  for (const Case& c : cases()) {
    const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal, MapKind::kPosition}));
    const MapLayout& layout = maps.maps[0].layout;
    const PatchNeighbours neighbours(layout.inner(), c.image.layout.adjacency);
    for (std::int32_t p = 0; p < c.image.size(); ++p) {
      for (std::int32_t side = 0; side < 4; ++side) {
        for (std::int32_t k = 0; k < layout.inner(); ++k) {
          for (std::int32_t depth = 0; depth <= layout.gutter; ++depth) {
            const PatchSample here = neighbours.on_side({p, side}, k, -depth);
            const PatchSample there = neighbours.across({p, side}, k, depth);
            for (const BakedMap& map : maps.maps) {
              ASSERT_EQ(tile_texel(map, p, here.i, here.j), tile_texel(map, there.patch, there.i, there.j))
                  << "patch " << p << ", side " << side << ", texel " << k << ", " << depth << " beyond";
            }
          }
        }
      }
    }
  }
}

TEST(Bake, LeavesNoJumpsInGuttersAndTheirCorners) {
  for (const Case& c : cases()) {
    const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kPosition}));
    const BakedMap& map = maps.maps[0];
    const std::int32_t first = -map.layout.gutter;
    const std::int32_t last = map.layout.inner() - 1 + map.layout.gutter_of(map.layout.tile);
    // A texel is this wide inside; in the gutter, neighbours turn in at an angle.
    double widest = 0;
    for (std::int32_t p = 0; p < c.image.size(); ++p) {
      for (std::int32_t k = 0; k + 1 < map.layout.inner(); ++k) {
        widest = std::max(widest, (tile_texel(map, p, k, 0) - tile_texel(map, p, k + 1, 0)).length());
        widest = std::max(widest, (tile_texel(map, p, k, k) - tile_texel(map, p, k + 1, k + 1)).length());
      }
    }
    for (std::int32_t p = 0; p < c.image.size(); ++p) {
      for (std::int32_t j = first; j <= last; ++j) {
        for (std::int32_t i = first; i < last; ++i) {
          const bool corner = (i < 0 || i + 1 >= map.layout.inner()) && (j < 0 || j >= map.layout.inner());
          // Around a domain vertex or barycentre there is less (or more) than a full turn to continue into.
          const double allowed = corner ? 2.0 * map.layout.gutter + 1 : 1.5;
          ASSERT_LT((tile_texel(map, p, i, j) - tile_texel(map, p, i + 1, j)).length(), allowed * widest);
        }
      }
    }
  }
}

TEST(Bake, OfTangentNormalsKeepsGuttersInThePatchsOwnFrame) {
  const Case c = sphere(fixtures::icosahedron(), 0.02);
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kTangentNormal, MapKind::kObjectNormal}));
  const BakedMap& tangent = *maps.find(MapKind::kTangentNormal);
  const BakedMap& object = *maps.find(MapKind::kObjectNormal);
  const FrameVertices frames = frame_vertices(c.image, 0, tangent.layout);
  for (std::int32_t p = 0; p < c.image.size(); ++p) {
    for (std::int32_t depth = 1; depth <= tangent.layout.gutter; ++depth) {
      // Beside the corner (0, 0), across the side u = 0.
      const FrameVertex* corner = &frames.at(p, 0, 0);
      const ShadingFrame frame = shading_frame({corner, corner, corner}, {1, 0, 0});
      const Vec3d expected = tile_texel(object, p, -depth, 0);
      EXPECT_LT(angle(frame.to_object(tile_texel(tangent, p, -depth, 0)), expected), 1e-3);
    }
  }
}

TEST(Bake, FallsBackEverywhereWhereTheCageIsZero) {
  const Case c = sphere(fixtures::octahedron(), 0.02);
  BakeOptions options = small({MapKind::kObjectNormal});
  options.cage_distance = 0;
  const BakedMaps none = bake(c.mesh, c.map, c.image, options);
  EXPECT_EQ(none.statistics.rays, 0);
  EXPECT_EQ(none.statistics.fallback_texels, none.statistics.texels);
  options.projection = Projection::kCorrespondence;
  const BakedMaps correspondence = bake(c.mesh, c.map, c.image, options);
  EXPECT_EQ(none.maps[0].texels, correspondence.maps[0].texels);
  EXPECT_EQ(correspondence.statistics.fallback_texels, 0);
}

TEST(Bake, CountsEveryInnerTexelOnce) {
  const Case c = sphere(fixtures::octahedron());
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal}));
  const std::int64_t inner = maps.maps[0].layout.inner();
  EXPECT_EQ(maps.statistics.texels, c.image.size() * inner * inner);
  EXPECT_EQ(maps.statistics.rays, 2 * maps.statistics.texels);
}

TEST(Bake, FallsBackWhereRaysMeetBackSides) {
  // A sphere that is turned inside out shows its backs alone.
  Case c = sphere(fixtures::octahedron());
  for (Vec3f& n : c.image.levels[0].normals) n = -n;
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal}));
  EXPECT_EQ(maps.statistics.fallback_texels, maps.statistics.texels);
}

TEST(Bake, MeasuresACageThatReachesTheSource) {
  for (const double bumps : {0.0, 0.01, 0.05}) {
    const Case c = sphere(fixtures::icosahedron(), bumps);
    const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal}));
    EXPECT_GT(maps.statistics.cage_distance, bumps);
    EXPECT_LT(maps.statistics.cage_distance, 2.5 * bumps + 0.05);
    EXPECT_LE(maps.statistics.fallback_texels, maps.statistics.texels / 1000);
  }
}

TEST(Bake, MeasuresTheCageAwayFromTheSamples) {
  // At the samples themselves, the level of detail lies on the source.
  for (int k = 1; k <= 5; ++k) {
    Case c = sphere(fixtures::icosahedron(), 0, 32);
    c.image = fixtures::sphere_image(fixtures::icosahedron(), k);
    const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal}));
    EXPECT_GT(maps.statistics.cage_distance, 1e-4);
    EXPECT_LE(maps.statistics.fallback_texels, maps.statistics.texels / 1000);
  }
}

TEST(Bake, LeavesAConvexBodyOpen) {
  const Case c = sphere(fixtures::icosahedron());
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kOcclusion}));
  const BakedMap& map = maps.maps[0];
  EXPECT_EQ(map.channels, 1);
  EXPECT_EQ(map.shrink, 4);
  EXPECT_EQ(map.width(), 80);
  const auto dark = std::count_if(map.texels.begin(), map.texels.end(), [](float t) { return t < 1; });
  EXPECT_EQ(dark, 0);
}

TEST(Bake, DarkensAPit) {
  // The source has a deep round pit at +z, the level of detail follows it.
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 32);
  GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 4);
  const auto dig = [](Vec3f& p) { p *= 1 - 0.7F * std::exp(-12 * (1 - p.z)); };
  for (Vec3f& p : mesh.positions) dig(p);
  for (GeometryLevel& level : image.levels) {
    for (Vec3f& p : level.positions) dig(p);
  }
  const BakedMaps maps = bake(mesh, map, image, small({MapKind::kOcclusion, MapKind::kPosition}));
  const BakedMap& occlusion = maps.maps[0];
  const BakedMap& positions = maps.maps[1];
  double pit = 0;
  double outside = 0;
  int pit_texels = 0;
  int outside_texels = 0;
  for (std::int32_t y = 0; y < occlusion.height(); ++y) {
    for (std::int32_t x = 0; x < occlusion.width(); ++x) {
      const Vec3d p = texel(positions, 4 * x + 2, 4 * y + 2);
      const float open = occlusion.texels[static_cast<std::size_t>(y) * occlusion.width() + x];
      if (p.z > 0 && p.z < 0.6 && std::hypot(p.x, p.y) < 0.15) {
        pit += open;
        ++pit_texels;
      } else if (p.z < -0.2) {
        outside += open;
        ++outside_texels;
      }
    }
  }
  ASSERT_GT(pit_texels, 0);
  ASSERT_GT(outside_texels, 0);
  EXPECT_LT(pit / pit_texels, 0.6);
  EXPECT_GT(outside / outside_texels, 0.999);
}

TEST(Bake, LeavesTilesWithoutAPatchFlat) {
  const Case c = sphere(fixtures::tetrahedron());  // 6 patches in 3 x 2 tiles
  const BakedMaps maps = bake(c.mesh, c.map, c.image, small({MapKind::kTangentNormal, MapKind::kOcclusion}));
  EXPECT_EQ(texel(maps.maps[0], 319, 319), Vec3d(0, 0, 1));
  EXPECT_EQ(maps.maps[1].texels.back(), 1);
}

TEST(Bake, GivesTheSameBitsOnAnyNumberOfThreads) {
  const Case c = sphere(fixtures::icosahedron(), 0.03);
  const auto baked = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return bake(c.mesh, c.map, c.image,
                small({MapKind::kTangentNormal, MapKind::kObjectNormal, MapKind::kOcclusion, MapKind::kPosition}));
  };
  const BakedMaps one = baked(1);
  const BakedMaps two = baked(2);
  ASSERT_EQ(one.maps.size(), two.maps.size());
  for (std::size_t m = 0; m < one.maps.size(); ++m) EXPECT_EQ(one.maps[m].texels, two.maps[m].texels);
  EXPECT_EQ(one.statistics.rays, two.statistics.rays);
  EXPECT_EQ(one.statistics.fallback_texels, two.statistics.fallback_texels);
  EXPECT_EQ(one.statistics.cage_distance, two.statistics.cage_distance);
}

TEST(Bake, TellsHowFarItIs) {
  const Case c = sphere(fixtures::tetrahedron());
  double last = 0;
  int calls = 0;
  bake(c.mesh, c.map, c.image, small({MapKind::kObjectNormal}), [&](std::string_view, double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
    ++calls;
  });
  EXPECT_EQ(last, 1);
  EXPECT_GT(calls, 10);
}

TEST(Bake, RefusesOptionsThatMakeNoSense) {
  const Case c = sphere(fixtures::tetrahedron());
  const auto code_of = [&](auto change) {
    BakeOptions options = small({MapKind::kObjectNormal});
    change(options);
    try {
      bake(c.mesh, c.map, c.image, options);
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::kDone;
  };
  EXPECT_EQ(code_of([](BakeOptions& o) { o.level = 4; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.level = -1; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.cage_distance = -1; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.cage_distance = std::nan(""); }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.occlusion_rays = 0; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.occlusion_size = 0; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.occlusion_distance = -2; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.size = -1; }), ExitCode::kUsage);
  EXPECT_EQ(code_of([](BakeOptions& o) { o.size = 10; }), ExitCode::kLimit);
}

TEST(Bake, RefusesInputsThatDoNotBelongTogether) {
  const Case a = sphere(fixtures::tetrahedron());
  const Case b = sphere(fixtures::octahedron());
  EXPECT_THROW(bake(a.mesh, a.map, b.image, small({MapKind::kObjectNormal})), Error);
  EXPECT_THROW(bake(b.mesh, a.map, a.image, small({MapKind::kObjectNormal})), Error);
}

}  // namespace
}  // namespace lozenge
