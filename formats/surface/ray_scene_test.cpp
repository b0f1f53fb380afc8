#include "formats/surface/ray_scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "formats/base/parallel.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/nearest_point.h"

namespace lozenge {
namespace {

SourceMesh sphere() { return fixtures::subdivided_sphere(fixtures::icosahedron(), 12).first; }

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Vec3d point(double extent) {
    const double x = number(-extent, extent);
    const double y = number(-extent, extent);
    return {x, y, number(-extent, extent)};
  }
  Vec3d direction() {
    Vec3d d(0, 0, 0);
    while (d.length() < 0.1 || d.length() > 1) d = point(1);
    return d.normalized();
  }

 private:
  std::mt19937 random_;
};

Vec3d point_at(const SourceMesh& mesh, TriangleId t, const Vec3d& w) {
  Vec3d p(0, 0, 0);
  for (int c = 0; c < 3; ++c) p += Vec3d(mesh.positions[mesh.triangles[t][c]]) * w[c];
  return p;
}

TEST(RayScene, LetsNoRayFromTheInsideOfAClosedSurfaceSlipBetweenTwoTriangles) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3d origin = dice.point(0.3);
    Ray ray{origin, dice.direction()};
    if (i % 2 == 0) {  // aimed at an edge
      const auto& t = mesh.triangles[(i * 7) % mesh.triangles.size()];
      const double s = dice.number(0.01, 0.99);
      ray.direction = Vec3d(mesh.positions[t[0]]) * s + Vec3d(mesh.positions[t[1]]) * (1 - s) - origin;
    }
    const RayHit hit = scene.closest_hit(ray);
    ASSERT_TRUE(hit.exists()) << "ray " << i;
    EXPECT_FALSE(hit.front);
    EXPECT_TRUE(scene.occluded(ray));
    const Vec3d on_ray = ray.origin + ray.direction * hit.distance;
    EXPECT_LT((point_at(mesh, hit.triangle, hit.weights) - on_ray).length(), 2e-6);
    EXPECT_GE(std::min({hit.weights.x, hit.weights.y, hit.weights.z}), 0);
  }
}

TEST(RayScene, LetsNoRayOfAPacketSlipBetweenTwoTrianglesAndMeetsEachWhereTheRayByItselfMeetsSomething) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(11);
  for (int packet = 0; packet < 4000; ++packet) {
    // As the texels of a row look: side by side and nearly the same way; of every other packet the edge itself, and
    // of every other from just before it.
    const auto& t = mesh.triangles[(packet * 7) % mesh.triangles.size()];
    const bool is_near = packet / 2 % 2 == 0;
    const Vec3d origin = dice.point(0.3);
    std::array<Ray, RayScene::kPacket> rays;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double s = (static_cast<double>(i) + 1) / (rays.size() + 1);
      Vec3d at = Vec3d(mesh.positions[t[0]]) * s + Vec3d(mesh.positions[t[1]]) * (1 - s);
      if (packet % 2 == 0) at += dice.point(0.02);
      rays[i] = {is_near ? at * 0.95 : origin, is_near ? at.normalized() : at - origin, 0, is_near ? 0.1 : 10};
    }
    std::array<RayHit, RayScene::kPacket> hits;
    scene.closest_hits(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RayHit alone = scene.closest_hit(rays[i]);
      ASSERT_EQ(hits[i].exists(), alone.exists()) << "packet " << packet << " ray " << i;
      ASSERT_TRUE(hits[i].exists()) << "packet " << packet << " ray " << i;
      EXPECT_NEAR(hits[i].distance, alone.distance, 2e-6);
    }
  }
}

TEST(RayScene, LetsHardlyAnyRaySlipThroughAVertexThatItIsAimedAt) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(5);
  int slipped = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3d origin = dice.point(0.3);
    const Vec3d at(mesh.positions[i % mesh.positions.size()]);
    if (!scene.closest_hit({origin, at - origin}).exists()) ++slipped;
  }
  EXPECT_LE(slipped,
            100);  // Embree is watertight along edges; where six triangles meet, rounding can cheat all of them
}

TEST(RayScene, SeesFrontsFromTheOutside) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3d direction = dice.direction();
    const RayHit hit = scene.closest_hit({direction * 3.0, -direction});
    ASSERT_TRUE(hit.exists());
    EXPECT_TRUE(hit.front);
    EXPECT_NEAR(hit.distance, 2, 0.02);  // chords of the subdivided sphere lie up to 1 - cos(3.6 degrees) below it
  }
}

TEST(RayScene, FindsNothingOutsideTheRaysRange) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  EXPECT_FALSE(scene.closest_hit({{0, 0, 3}, {0, 0, 1}}).exists());
  EXPECT_FALSE(scene.occluded({{0, 0, 3}, {0, 0, 1}}));
  EXPECT_FALSE(scene.closest_hit({{0, 0, 3}, {0, 0, -1}, 0, 1.9}).exists());
  EXPECT_FALSE(scene.occluded({{0, 0, 3}, {0, 0, -1}, 0, 1.9}));
  EXPECT_TRUE(scene.occluded({{0, 0, 3}, {0, 0, -1}, 0, 2.1}));
  // Past the near side, the far side is met.
  EXPECT_NEAR(scene.closest_hit({{0.1, 0.2, 3}, {0, 0, -1}, 2.5}).distance, 3 + std::sqrt(1 - 0.05), 0.02);
}

TEST(RayScene, GivesTheNearestPointThatASearchOverAllTrianglesGives) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3d p = dice.point(1.5);
    double least = std::numeric_limits<double>::infinity();
    for (TriangleId t = 0; t < static_cast<TriangleId>(mesh.triangles.size()); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const std::array<Vec3d, 3> corners{Vec3d(mesh.positions[a]), Vec3d(mesh.positions[b]), Vec3d(mesh.positions[c])};
      least = std::min(least, (point_at(mesh, t, nearest_weights(p, corners)) - p).length());
    }
    const NearestPoint found = scene.nearest(p);
    ASSERT_TRUE(found.exists());
    EXPECT_NEAR(found.distance, least, 1e-7);
    EXPECT_NEAR((found.point - p).length(), found.distance, 1e-12);
    EXPECT_LT((point_at(mesh, found.triangle, found.weights) - found.point).length(), 1e-6);
    EXPECT_FALSE(scene.nearest(p, least * 0.999).exists());
    EXPECT_TRUE(scene.nearest(p, least * 1.001).exists());
  }
}

TEST(RayScene, GivesTheSameNearestPointWhereverTheSearchBegins) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(12);
  for (int i = 0; i < 2000; ++i) {
    // Some of them in vertices, which are as near to six triangles.
    const Vec3d p = i % 3 == 0 ? Vec3d(mesh.positions[i % mesh.positions.size()]) : dice.point(1.5);
    const NearestPoint nearest = scene.nearest(p);
    const auto anywhere = static_cast<TriangleId>((i * 17) % mesh.triangles.size());
    for (const TriangleId close : {TriangleId{-1}, anywhere, nearest.triangle}) {
      const NearestPoint again = scene.nearest_from(close, p);
      ASSERT_EQ(again.triangle, nearest.triangle);
      EXPECT_EQ(again.weights, nearest.weights);
      EXPECT_EQ(again.distance, nearest.distance);
    }
  }
}

TEST(RayScene, GivesTheNearestPointOfTheTrianglesThatCountAlone) {
  const SourceMesh mesh = sphere();
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(5);
  for (int i = 0; i < 100; ++i) {
    const Vec3d p = dice.point(1.5);
    const NearestPoint any = scene.nearest(p);
    EXPECT_EQ(scene.nearest_of([&](TriangleId t) { return t == any.triangle; }, p).triangle, any.triangle);
    const NearestPoint other = scene.nearest_of([&](TriangleId t) { return t != any.triangle; }, p);
    EXPECT_NE(other.triangle, any.triangle);
    EXPECT_GE(other.distance, any.distance);
    EXPECT_FALSE(scene.nearest_of([](TriangleId) { return false; }, p).exists());
  }
}

TEST(RayScene, IsAsPreciseFarFromTheOrigin) {
  SourceMesh mesh = sphere();
  const Vec3f far(65536, -32768, 65536);  // where floats are 1/128 apart
  for (Vec3f& p : mesh.positions) p = p * 64.0F + far;
  const RayScene scene(mesh.positions, mesh.triangles);
  Dice dice(4);
  for (int i = 0; i < 2000; ++i) {
    const TriangleId t = static_cast<TriangleId>(dice.number(0, static_cast<double>(mesh.triangles.size()) - 1));
    Vec3d w(dice.number(0.1, 1), dice.number(0.1, 1), dice.number(0.1, 1));
    w /= w.x + w.y + w.z;
    const Vec3d p = point_at(mesh, t, w);
    const NearestPoint found = scene.nearest(p);
    EXPECT_LT(found.distance, 1e-10);
    const RayHit hit = scene.closest_hit({p * 0.5 + Vec3d(far) * 0.5, p - Vec3d(far)});
    ASSERT_TRUE(hit.exists());
    EXPECT_LT((point_at(mesh, hit.triangle, hit.weights) - p).length(), 64 * 2e-6);
  }
}

TEST(RayScene, PutsUpWithTrianglesWithoutArea) {
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  const RayScene scene(positions, {{0, 1, 2}, {3, 3, 3}});
  EXPECT_FALSE(scene.closest_hit({{0.5, 0, 1}, {0, 0, -1}}).exists());
  const NearestPoint on_needle = scene.nearest({1.5, 1, 0});
  EXPECT_EQ(on_needle.triangle, 0);
  EXPECT_NEAR((on_needle.point - Vec3d(1.5, 0, 0)).length(), 0, 1e-6);
  EXPECT_EQ(scene.nearest({5, 5, 6}).triangle, 1);
}

TEST(RayScene, OfNothingIsNeverHit) {
  const RayScene scene({}, {});
  EXPECT_FALSE(scene.closest_hit({}).exists());
  EXPECT_FALSE(scene.occluded({}));
  EXPECT_FALSE(scene.nearest({0, 0, 0}).exists());
}

TEST(RayScene, GivesTheSameAnswersOnAnyNumberOfThreads) {
  const SourceMesh mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), 40).first;
  constexpr int kQueries = 20000;
  const auto answers = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const RayScene scene(mesh.positions, mesh.triangles);
    std::vector<std::array<double, 5>> result(kQueries);
    for_each_index(kQueries, true, [&](std::size_t i) {
      Dice dice(static_cast<unsigned>(i));
      // At vertices, where six triangles compete.
      const Vec3d at(mesh.positions[i % mesh.positions.size()]);
      const RayHit hit = scene.closest_hit({dice.point(0.3), at});
      const NearestPoint near = scene.nearest(at * dice.number(0.5, 1.5));
      result[i] = {1.0 * hit.triangle, hit.weights.y, hit.distance, 1.0 * near.triangle, near.weights.y};
    });
    return result;
  };
  EXPECT_EQ(answers(1), answers(4));
}

}  // namespace
}  // namespace lozenge
