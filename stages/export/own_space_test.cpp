#include "stages/export/own_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <set>

#include "formats/surface/body_fixtures.h"

namespace lozenge {
namespace {

using Imath::M44d;

Vec3f random_vector(std::mt19937& random) {
  std::uniform_real_distribution<float> number(-1, 1);
  return {number(random), number(random), number(random)};
}

/// Triangles that face anywhere, normals and tangents at right angles.
EngineMesh random_mesh(std::size_t triangles, std::mt19937& random) {
  EngineMesh mesh;
  for (std::size_t v = 0; v < 3 * triangles; ++v) {
    mesh.positions.push_back(random_vector(random));
    const Vec3f normal = random_vector(random).normalized();
    const Vec3f tangent = normal.cross(random_vector(random)).normalized();
    mesh.normals.push_back(normal);
    mesh.tangents.emplace_back(tangent.x, tangent.y, tangent.z, random() % 2 == 0 ? 1 : -1);
    mesh.texcoords.emplace_back(0, 0);
    mesh.indices.push_back(static_cast<std::uint32_t>(v));
  }
  return mesh;
}

constexpr std::size_t kWidth = kInfluences.components;

/// Up to eight of the joints, in any order, with any weights.
void add_random_influences(EngineMesh& mesh, std::size_t joints, std::mt19937& random) {
  std::uniform_real_distribution<float> number(0, 1);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::array<float, kWidth> influence{};
    float total = 0;
    const std::size_t count = 1 + random() % kMostJoints;
    for (std::size_t i = 0; i < count; ++i) {
      influence[i] = static_cast<float>((v + i) % joints);
      influence[kMostJoints + i] = number(random) + 1e-6F;
      total += influence[kMostJoints + i];
    }
    for (std::size_t i = 0; i < kMostJoints; ++i) influence[kMostJoints + i] /= total;
    mesh.influences.insert(mesh.influences.end(), influence.begin(), influence.end());
  }
}

/// Joints that stand near each other, as those of a skeleton do: turned a little, moved, and scaled alike.
std::vector<M44d> random_joints(std::size_t count, double scale, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-0.4, 0.4);
  std::vector<M44d> joints;
  for (std::size_t j = 0; j < count; ++j) {
    M44d m;
    m.rotate(Imath::V3d(number(random), number(random), number(random)));
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) m[row][column] *= scale;
    }
    m.translate(Imath::V3d(number(random), number(random), number(random)));
    joints.push_back(m);
  }
  return joints;
}

void expect_unit_frames(const EngineMesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f tangent(mesh.tangents[v].x, mesh.tangents[v].y, mesh.tangents[v].z);
    EXPECT_NEAR(mesh.normals[v].length(), 1, 1e-5);
    EXPECT_NEAR(tangent.length(), 1, 1e-5);
    EXPECT_NEAR(mesh.normals[v].dot(tangent), 0, 1e-5);
  }
}

TEST(OwnSpace, OfASkinIsWhereItsJointsBringTheMeshBackFrom) {
  std::mt19937 random(1);
  for (const double scale : {0.01, 1.0, 100.0}) {
    const std::vector<M44d> joints = random_joints(6, scale, random);
    const EngineMesh stood = [&] {
      EngineMesh mesh = random_mesh(200, random);
      add_random_influences(mesh, joints.size(), random);
      return mesh;
    }();
    EngineMesh mesh = stood;
    move_to_space_of_skin(mesh, joints);
    expect_unit_frames(mesh);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const float* influence = &mesh.influences[kWidth * v];
      const Vec3d back = placed(blended(joints, influence), Vec3d(mesh.positions[v]));
      EXPECT_LT((back - Vec3d(stood.positions[v])).length(), 1e-5) << "with the weights that the file holds";
      int steps = 0;
      for (int i = kMostJoints; i < 2 * kMostJoints; ++i) {
        EXPECT_NEAR(influence[i], stood.influences[kWidth * v + static_cast<std::size_t>(i)], 1.0 / kWholeWeight);
        const double exact = static_cast<double>(influence[i]) * kWholeWeight;
        EXPECT_NEAR(exact, std::round(exact), 0.01);
        steps += static_cast<int>(std::lround(exact));
        EXPECT_TRUE(influence[i] > 0 || influence[i - kMostJoints] == 0) << "a joint that weighs nothing is not named";
      }
      EXPECT_EQ(steps, kWholeWeight);
    }
  }
}

TEST(OwnSpace, KeepsVerticesEqualThatWere) {
  std::mt19937 random(2);
  const std::vector<M44d> joints = random_joints(4, 0.01, random);
  EngineMesh mesh = random_mesh(50, random);
  add_random_influences(mesh, joints.size(), random);
  for (std::size_t v = 0; v + 1 < mesh.positions.size(); v += 2) {
    mesh.positions[v + 1] = mesh.positions[v];
    std::memcpy(&mesh.influences[kWidth * (v + 1)], &mesh.influences[kWidth * v], kWidth * sizeof(float));
  }
  move_to_space_of_skin(mesh, joints);
  for (std::size_t v = 0; v + 1 < mesh.positions.size(); v += 2) {
    EXPECT_EQ(std::memcmp(&mesh.positions[v], &mesh.positions[v + 1], sizeof(Vec3f)), 0);
    EXPECT_EQ(std::memcmp(&mesh.influences[kWidth * v], &mesh.influences[kWidth * (v + 1)], kWidth * sizeof(float)), 0);
  }
}

TEST(OwnSpace, SurvivesJointsThatLeaveNoExtentBetweenThem) {
  const M44d half_turn(-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  EngineMesh mesh;
  mesh.positions = {{1, 2, 3}};
  mesh.normals = {{1, 0, 0}};
  mesh.tangents = {{0, 1, 0, 1}};
  mesh.influences = {0, 1, 0, 0, 0, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0, 0, 0, 0};
  move_to_space_of_skin(mesh, {M44d(), half_turn});
  EXPECT_TRUE(std::isfinite(mesh.positions[0].length()));
  expect_unit_frames(mesh);
}

TEST(OwnSpace, OfANodeIsWhereItsPlacementTakesTheMeshFrom) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    Placement placement = fixtures::random_placement(random);
    for (int c = 0; c < 3; ++c)
      placement[static_cast<std::size_t>(c)] += 0.3 * placement[4 + static_cast<std::size_t>(c)];
    const EngineMesh stood = random_mesh(20, random);
    EngineMesh mesh = stood;
    move_to_own_space(mesh, placement);
    expect_unit_frames(mesh);
    const bool mirrors = is_mirroring(placement);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      EXPECT_LT((placed(placement, mesh.positions[v]) - stood.positions[v]).length(), 1e-3F);
      EXPECT_EQ(mesh.tangents[v].w, mirrors ? -stood.tangents[v].w : stood.tangents[v].w);
    }
    EXPECT_EQ(mesh.indices[1] == stood.indices[1], !mirrors) << "triangles turn with it";
  }
}

TEST(OwnSpace, KeepsPlacesApartWhereItsFloatsAreCoarse) {
  // Modelled a million units from its origin: floats are a sixteenth apart there.
  Rig rig;
  rig.nodes.push_back({"far", -1, {}, {-1e6, 0, 0}, {}, {}});
  std::vector<LeveledPart> parts(1);
  parts[0].body = {"far", {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1e6, 0, 0, 1}, 0}}, -1};
  EngineMesh mesh;
  for (int v = 0; v < 300; ++v) {
    mesh.positions.emplace_back(0.01F * static_cast<float>(v / 2), 0.0F, 0.0F);  // each twice
    mesh.normals.emplace_back(0, 0, 1);
    mesh.tangents.emplace_back(1, 0, 0, 1);
    mesh.indices.push_back(static_cast<std::uint32_t>(v));
  }
  parts[0].levels.resize(2);
  parts[0].levels[0].sampled = parts[0].levels[1].sampled = mesh;
  move_to_own_spaces(parts, rig, {0, 0, 0});
  const std::vector<Vec3f>& own = parts[0].levels[0].sampled.positions;
  EXPECT_EQ(own, parts[0].levels[1].sampled.positions) << "the same on all levels";
  std::set<std::array<float, 3>> places;
  for (std::size_t v = 0; v < own.size(); v += 2) {
    EXPECT_EQ(own[v], own[v + 1]);
    places.insert({own[v].x, own[v].y, own[v].z});
    EXPECT_LT((own[v] - Vec3f(1e6F, 0, 0) - mesh.positions[v]).length(), 1.0F);
  }
  EXPECT_EQ(places.size(), own.size() / 2);
}

TEST(OwnSpace, LeavesWhatStandsStillAsItIs) {
  std::mt19937 random(4);
  const EngineMesh stood = random_mesh(20, random);
  EngineMesh mesh = stood;
  move_to_own_space(mesh, kUnmoved);
  EXPECT_EQ(mesh.positions, stood.positions);
  EXPECT_EQ(mesh.tangents, stood.tangents);
}

}  // namespace
}  // namespace lozenge
