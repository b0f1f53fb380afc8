#include "formats/patches/tangent_frame.h"

#include <gtest/gtest.h>

#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

std::vector<GeometryImage> spheres() {
  return {fixtures::sphere_image(fixtures::tetrahedron(), 3), fixtures::sphere_image(fixtures::octahedron(), 2),
          fixtures::sphere_image(fixtures::icosahedron(), 2)};
}

MapLayout layout_of(const GeometryImage& image) { return make_map_layout(image.layout, 512, 4); }

template <typename F>
void for_each_vertex(const GeometryImage& image, int level, const F& f) {
  const FrameVertices frames = frame_vertices(image, level, layout_of(image));
  for (std::int32_t p = 0; p < image.size(); ++p) {
    for (std::int32_t j = 0; j < frames.grids.samples(p); ++j) {
      for (std::int32_t i = 0; i < frames.grids.samples(p); ++i) f(frames, p, i, j);
    }
  }
}

TEST(FrameVertices, HaveUnitNormalsAndUnitTangentsAtARightAngle) {
  for (const GeometryImage& image : spheres()) {
    for (int level = 0; level < static_cast<int>(image.levels.size()); ++level) {
      for_each_vertex(image, level, [&](const FrameVertices& frames, std::int32_t p, std::int32_t i, std::int32_t j) {
        const FrameVertex& v = frames.at(p, i, j);
        EXPECT_NEAR(Vec3d(v.normal).length(), 1, 1e-6);
        EXPECT_NEAR(Vec3d(v.tangent).length(), 1, 1e-6);
        EXPECT_NEAR(Vec3d(v.normal).dot(Vec3d(v.tangent)), 0, 1e-6);
      });
    }
  }
}

TEST(FrameVertices, PointToTheRightAndUpInTheTexture) {
  for (const GeometryImage& image : spheres()) {
    const GeometryLevel& level = image.levels[0];
    for_each_vertex(image, 0, [&](const FrameVertices& frames, std::int32_t p, std::int32_t i, std::int32_t j) {
      // Differences along the grid, by texture coordinates: x grows to the right, y down.
      const std::int32_t last = frames.grids.samples(p) - 1;
      const auto position = [&](std::int32_t k, std::int32_t l) {
        return Vec3d(level.positions[image.index(level, p, k, l)]);
      };
      const std::int32_t i1 = std::min(i + 1, last);
      const std::int32_t j1 = std::min(j + 1, last);
      const Vec3d right = position(i1, j) - position(i1 - 1, j);
      const Vec3d down = position(i, j1) - position(i, j1 - 1);
      EXPECT_GT(frames.at(p, i1, j).texcoord.x, frames.at(p, i1 - 1, j).texcoord.x);
      EXPECT_GT(frames.at(p, i, j1).texcoord.y, frames.at(p, i, j1 - 1).texcoord.y);
      const FrameVertex& v = frames.at(p, i, j);
      const Vec4f tangent = v.tangent_with_sign();
      const Vec3d t(tangent.x, tangent.y, tangent.z);
      const Vec3d bitangent = Vec3d(v.normal).cross(t) * static_cast<double>(tangent.w);
      EXPECT_GT(t.dot(right.normalized()), 0.9);
      // The patch is a rhombus, so up is not opposite to down, but on its side.
      EXPECT_LT(bitangent.dot(down.normalized()), -0.5);
    });
  }
}

TEST(FrameVertices, LieWhereTheirTexelsAre) {
  const GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 2);
  const MapLayout layout = layout_of(image);
  for_each_vertex(image, 1, [&](const FrameVertices& frames, std::int32_t p, std::int32_t i, std::int32_t j) {
    const Vec2d expected = layout.texcoord(p, i / 2.0, j / 2.0);
    EXPECT_EQ(frames.at(p, i, j).texcoord, Vec2f(expected));
  });
}

TEST(FrameVertices, OfAPatchOnTheSurfacesBoundaryUseItsHalfAlone) {
  GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 2);
  image.layout.places[0].right = {};
  GeometryLevel& level = image.levels[0];
  const FrameVertices whole = frame_vertices(fixtures::sphere_image(fixtures::octahedron(), 2), 0, layout_of(image));
  for (std::int32_t j = 0; j < level.samples; ++j) {
    for (std::int32_t i = j + 1; i < level.samples; ++i) {
      level.positions[image.index(level, 0, i, j)] = {0, 0, 0};
      level.normals[image.index(level, 0, i, j)] = {0, 0, 0};
    }
  }
  const FrameVertices half = frame_vertices(image, 0, layout_of(image));
  for (std::int32_t j = 0; j < level.samples; ++j) {
    for (std::int32_t i = 0; i <= j; ++i) {
      // Triangles are missing around vertices on the diagonal, and halved beside it, which turns their tangents: on
      // these large faces by up to 21 and 8 degrees.
      const float least = j - i == 0 ? 0.93F : j - i == 1 ? 0.99F : 1 - 1e-6F;
      EXPECT_GT(half.at(0, i, j).tangent.dot(whole.at(0, i, j).tangent), least);
    }
    for (std::int32_t i = j + 1; i < level.samples; ++i) EXPECT_EQ(half.at(0, i, j).texcoord, Vec2f(0, 0));
  }
}

TEST(FrameVertices, AreFiniteWhereTrianglesHaveNoArea) {
  GeometryImage image = fixtures::sphere_image(fixtures::tetrahedron(), 2);
  GeometryLevel& level = image.levels[0];
  for (std::int32_t j = 0; j < level.samples; ++j) {
    for (std::int32_t i = 0; i < level.samples; ++i) {
      level.positions[image.index(level, 2, i, j)] = {1, 2, 3};
      if (i == 1) level.normals[image.index(level, 2, i, j)] = {0, 0, 0};
    }
  }
  for_each_vertex(image, 0, [&](const FrameVertices& frames, std::int32_t p, std::int32_t i, std::int32_t j) {
    EXPECT_NEAR(Vec3d(frames.at(p, i, j).tangent).length(), 1, 1e-6);
  });
}

TEST(FrameVertices, StayAtARightAngleWhereTheSurfaceStandsOnEnd) {
  // Normals along the direction of growing u, as smoothed ones of a ragged surface may be: no tangent follows from it.
  // Of equal coordinates, what rounding leaves beside the normal lies along it.
  GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 2);
  GeometryLevel& level = image.levels[0];
  for (const Vec3f& direction : {Vec3f(1, 1, 0), Vec3f(1, 1, 1), Vec3f(0, -1, 1), Vec3f(-1, 1, -1), Vec3f(1, 2, 3)}) {
    const Vec3f along = direction.normalized();
    for (std::int32_t p = 0; p < image.size(); ++p) {
      for (std::int32_t j = 0; j < level.samples; ++j) {
        for (std::int32_t i = 0; i < level.samples; ++i) {
          level.positions[image.index(level, p, i, j)] = along * static_cast<float>(i);
          level.normals[image.index(level, p, i, j)] = along;
        }
      }
    }
    for_each_vertex(image, 0, [&](const FrameVertices& frames, std::int32_t p, std::int32_t i, std::int32_t j) {
      const FrameVertex& v = frames.at(p, i, j);
      EXPECT_NEAR(Vec3d(v.tangent).length(), 1, 1e-6);
      EXPECT_NEAR(Vec3d(v.normal).dot(Vec3d(v.tangent)), 0, 1e-6);
    });
  }
}

TEST(ShadingFrame, GivesEveryDirectionBack) {
  const GeometryImage image = fixtures::sphere_image(fixtures::tetrahedron(), 2);
  const FrameVertices frames = frame_vertices(image, 0, layout_of(image));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  std::uniform_int_distribution<std::int32_t> at(0, frames.grids.samples(0) - 2);
  for (int n = 0; n < 2000; ++n) {
    const std::int32_t p = n % image.size();
    const std::int32_t i = at(random);
    const std::int32_t j = at(random);
    Vec3d weights(std::abs(number(random)), std::abs(number(random)), std::abs(number(random)) + 0.01);
    weights /= weights.x + weights.y + weights.z;
    const ShadingFrame frame =
        shading_frame({&frames.at(p, i, j), &frames.at(p, i + 1, j), &frames.at(p, i, j + 1)}, weights);
    const Vec3d direction = Vec3d(number(random), number(random), number(random) + 1e-3).normalized();
    const Vec3d texel = frame.to_texel(direction);
    EXPECT_NEAR(texel.length(), 1, 1e-12);
    EXPECT_LT((frame.to_object(texel) - direction).length(), 1e-12);
    EXPECT_LT((frame.to_object({0, 0, 1}) - frame.normal).length(), 1e-12);
  }
}

TEST(ShadingFrame, ExistsWhereTangentsCancelEachOther) {
  const FrameVertex a{{0, 0, 1}, {1, 0, 0}, {}};
  const FrameVertex b{{0, 0, 1}, {-1, 0, 0}, {}};
  const ShadingFrame frame = shading_frame({&a, &b, &a}, {0.25, 0.5, 0.25});
  EXPECT_NEAR(frame.normal.cross(frame.tangent).length(), 1, 1e-12);
}

}  // namespace
}  // namespace lozenge
