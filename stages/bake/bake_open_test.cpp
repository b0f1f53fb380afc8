// Surfaces with a boundary: texels before it are baked like all others, those beyond it mirror them.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/domain/open_fixtures.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/patch_place.h"
#include "formats/patches/tangent_frame.h"
#include "formats/surface/boundary.h"
#include "formats/surface/nearest_point.h"
#include "formats/surface/ray_scene.h"
#include "stages/bake/bake.h"

namespace lozenge {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;

std::vector<fixtures::OpenSurface> surfaces() {
  return {fixtures::triangle(12),
          fixtures::hemisphere(16),
          fixtures::bowl(12),
          fixtures::fan(1, 12),
          fixtures::fan(2, 12),
          fixtures::fan(4, 12),
          fixtures::open_and_closed(12),
          fixtures::annulus(4, 61, 16, 0.375)};
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

double angle(const Vec3d& a, const Vec3d& b) { return std::atan2(a.cross(b).length(), a.dot(b)); }

TEST(BakeOpen, CountsTexelsBeyondTheBoundaryApart) {
  for (const fixtures::OpenSurface& open : surfaces()) {
    const GeometryImage image = fixtures::open_image(open, 4);
    const auto halves = std::count_if(image.layout.places.begin(), image.layout.places.end(),
                                      [](const PatchPlace& place) { return !place.right.exists(); });
    const BakedMaps maps = bake(open.mesh, open.map, image, small({MapKind::kObjectNormal, MapKind::kPosition}));
    const std::int64_t n = maps.maps[0].layout.inner();
    const std::int64_t beyond = halves * n * (n - 1) / 2;
    EXPECT_EQ(maps.statistics.unused_texels, 2 * beyond) << open.name;
    EXPECT_EQ(maps.statistics.texels, 2 * (image.size() * n * n - beyond)) << open.name;
    // The level of detail lies on the source up to the source's own facets; on the boundary no ray is shot.
    EXPECT_LE(maps.statistics.fallback_texels, maps.statistics.texels / 200) << open.name;
    EXPECT_EQ(maps.statistics.rays, maps.statistics.texels - 2 * halves * n) << open.name;
    const BakedMaps occlusion = bake(open.mesh, open.map, image, small({MapKind::kOcclusion}));
    EXPECT_GT(occlusion.statistics.unused_texels, 0) << open.name;
    EXPECT_LE(occlusion.statistics.fallback_texels, occlusion.statistics.texels / 50) << open.name;
  }
}

TEST(BakeOpen, OnADiagonalShowsTheSourcesBoundary) {
  for (const fixtures::OpenSurface& open : surfaces()) {
    const GeometryImage image = fixtures::open_image(open, 3);
    const BakedMaps maps = bake(open.mesh, open.map, image, small({MapKind::kPosition}));
    SourceMesh line;  // the texels of all diagonals, as triangles without area
    const std::int32_t n = maps.maps[0].layout.inner();
    for (std::int32_t p = 0; p < image.size(); ++p) {
      if (image.layout.places[p].right.exists()) continue;
      for (std::int32_t k = 0; k < n; ++k) line.positions.emplace_back(Vec3f(tile_texel(maps.maps[0], p, k, k)));
    }
    const std::vector<BoundarySide> sides = boundary_sides({open.mesh.positions, open.mesh.triangles});
    for (const Vec3f& point : line.positions) {
      double nearest = 1;
      for (const auto& [a, b] : sides) {
        const std::array<Vec3d, 3> side{Vec3d(open.mesh.positions[a]), Vec3d(open.mesh.positions[b]),
                                        Vec3d(open.mesh.positions[b])};
        const Vec3d w = nearest_weights(Vec3d(point), side);
        nearest = std::min(nearest, (side[0] * w.x + side[1] * (w.y + w.z) - Vec3d(point)).length());
      }
      EXPECT_LT(nearest, 1e-6) << open.name;
    }
  }
}

TEST(BakeOpen, MirrorsEveryHalfPatchInTheBoundaryGuttersToo) {
  for (const fixtures::OpenSurface& open : surfaces()) {
    const GeometryImage image = fixtures::open_image(open, 3);
    const BakedMaps maps = bake(open.mesh, open.map, image, small({MapKind::kObjectNormal, MapKind::kPosition}));
    const MapLayout& layout = maps.maps[0].layout;
    for (std::int32_t p = 0; p < image.size(); ++p) {
      if (image.layout.places[p].right.exists()) continue;
      for (std::int32_t j = -layout.gutter_of(layout.tile); j < layout.inner() + layout.gutter_of(layout.tile); ++j) {
        for (std::int32_t i = -layout.gutter_of(layout.tile); i < j; ++i) {
          for (const BakedMap& map : maps.maps) {
            ASSERT_EQ(tile_texel(map, p, i, j), tile_texel(map, p, j, i)) << open.name << ", " << p;
          }
        }
      }
    }
  }
}

TEST(BakeOpen, FillsEveryTexelOfEveryTile) {
  for (const fixtures::OpenSurface& open : surfaces()) {
    const GeometryImage image = fixtures::open_image(open, 3);
    const BakedMaps maps = bake(open.mesh, open.map, image, small({MapKind::kObjectNormal, MapKind::kTangentNormal}));
    const MapLayout& layout = maps.maps[0].layout;
    for (std::int32_t p = 0; p < image.size(); ++p) {
      for (std::int32_t j = -layout.gutter_of(layout.tile); j < layout.inner() + layout.gutter_of(layout.tile); ++j) {
        for (std::int32_t i = -layout.gutter_of(layout.tile); i < layout.inner() + layout.gutter_of(layout.tile); ++i) {
          for (const BakedMap& map : maps.maps) ASSERT_NEAR(tile_texel(map, p, i, j).length(), 1, 1e-5) << open.name;
        }
      }
    }
  }
}

TEST(BakeOpen, GivesARendererTheSourcesNormalsUpToTheBoundary) {
  for (const fixtures::OpenSurface& open : surfaces()) {
    const GeometryImage image = fixtures::open_image(open, 3);
    BakeOptions options = small({MapKind::kTangentNormal});
    options.size = 640;
    const BakedMap map = bake(open.mesh, open.map, image, options).maps[0];
    const FrameVertices frames = frame_vertices(image, 0, map.layout);
    const DomainLocator locator(open.mesh, open.map);
    const ShadingNormals source(open.mesh);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(0, 1);
    for (std::int32_t p = 0; p < image.size(); ++p) {
      if (image.layout.places[p].right.exists()) continue;
      for (int k = 0; k < 200; ++k) {
        // Along the boundary, less than a sample from it.
        const auto i = static_cast<std::int32_t>(number(random) * 8);
        const double along = number(random);
        const double depth = 0.2 * number(random) * std::min(along, 1 - along);
        const std::array<const FrameVertex*, 3> vertices{&frames.at(p, i, i), &frames.at(p, i + 1, i + 1),
                                                         &frames.at(p, i, i + 1)};
        const Vec3d weights(1 - along - depth / 2, along - depth / 2, depth);
        Vec2d texcoord(0, 0);
        for (int c = 0; c < 3; ++c) texcoord += Vec2d(vertices[c]->texcoord) * weights[c];
        const double x = texcoord.x * map.width() - 0.5;
        const double y = texcoord.y * map.height() - 0.5;
        const auto left = static_cast<std::int32_t>(std::floor(x));
        const auto top = static_cast<std::int32_t>(std::floor(y));
        const double s = x - left;
        const double t = y - top;
        const Vec3d seen = (texel(map, left, top) * (1 - s) + texel(map, left + 1, top) * s) * (1 - t) +
                           (texel(map, left, top + 1) * (1 - s) + texel(map, left + 1, top + 1) * s) * t;
        const double u = (i + weights.y) / 8;
        const double v = (i + weights.y + weights.z) / 8;
        const auto there = locator.find(domain_point_at(image.layout.places[p], u, v));
        ASSERT_TRUE(there.has_value());
        const Vec3d expected(source.at(there->triangle, there->weights));
        EXPECT_LT(angle(shading_frame(vertices, weights).to_object(seen), expected), 3 * kDegree) << open.name;
      }
    }
  }
}

TEST(BakeOpen, GivesTheSameBitsOnAnyNumberOfThreads) {
  const fixtures::OpenSurface open = fixtures::bowl(12);
  const GeometryImage image = fixtures::open_image(open, 3);
  const BakeOptions options = small({MapKind::kTangentNormal, MapKind::kOcclusion});
  const BakedMaps many = bake(open.mesh, open.map, image, options);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const BakedMaps alone = bake(open.mesh, open.map, image, options);
  for (std::size_t m = 0; m < many.maps.size(); ++m) EXPECT_EQ(many.maps[m].texels, alone.maps[m].texels);
  EXPECT_EQ(many.statistics.unused_texels, alone.statistics.unused_texels);
}

}  // namespace
}  // namespace lozenge
