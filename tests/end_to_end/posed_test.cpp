// What moves in an asset, moved: the skin of a level follows poses as the source's does.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/files/asset_file.h"
#include "formats/files/asset_places.h"
#include "formats/files/asset_pose.h"
#include "formats/surface/attribute_streams.h"
#include "stages/compare/compare.h"
#include "stages/import/import_surface.h"
#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using Imath::M44d;

struct Posed {
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> triangles;

  SurfaceView view() const { return {positions, triangles}; }
};

/// [joint] from the space of the mesh to the scene.
std::vector<M44d> joints_of(const Rig& rig) {
  const std::vector<M44d> transforms = rest_transforms(rig);
  std::vector<M44d> joints;
  for (std::size_t j = 0; j < rig.skins[0].joints.size(); ++j) {
    joints.push_back(matrix_of(rig.skins[0].inverse_binds[j]) * transforms[rig.skins[0].joints[j]]);
  }
  return joints;
}

/// Joints turned at random against those above them.
Rig posed_at_random(Rig rig, std::mt19937& random) {
  std::uniform_real_distribution<double> turn(-0.4, 0.4);
  for (const std::int32_t joint : rig.skins[0].joints) {
    const double x = turn(random);
    const double z = turn(random);
    const double length = std::sqrt(1 + x * x + z * z);
    rig.nodes[joint].rotation = {x / length, 0, z / length, 1 / length};
  }
  return rig;
}

/// The source's skin, taken back to where it was modelled and posed.
Posed posed(const SourceMesh& mesh, const std::vector<M44d>& rest, const std::vector<M44d>& joints) {
  Posed made;
  made.positions = mesh.positions;
  const AttributeStream* influences = find_stream(mesh.corner_attributes, kInfluences);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::int32_t body = mesh.bodies.owner_of(mesh.materials[t]);
    if (body < 0 || mesh.bodies.bodies[body].skin < 0) continue;
    made.triangles.push_back(mesh.triangles[t]);
    for (std::size_t c = 0; c < 3; ++c) {
      const VertexId v = mesh.triangles[t][c];
      const float* influence = influences->at(3 * t + c);
      const Vec3d modelled = placed(blended(rest, influence).inverse(), Vec3d(mesh.positions[v]));
      made.positions[v] = Vec3f(placed(blended(joints, influence), modelled));
    }
  }
  return made;
}

/// The skin of a level of an asset.
Posed posed(const AssetLevel& level, const std::vector<M44d>& joints) {
  Posed made;
  made.positions = level.positions;
  for (const AssetPart& part : level.parts) {
    if (part.joints.empty()) continue;
    for (std::size_t t = part.first_triangle; t < part.first_triangle + part.triangles; ++t) {
      made.triangles.push_back(level.triangles[t]);
      for (const VertexId v : level.triangles[t]) {
        made.positions[v] = Vec3f(placed(blended(joints, level.influence(v)), Vec3d(level.positions[v])));
      }
    }
  }
  return made;
}

using Poses = InOwnFolder<>;

TEST_F(Poses, MoveEachLevelOfASkinAsTheyMoveTheSource) {
  const SourceMesh source = import_surface(test_asset("worm.glb"));
  const std::vector<M44d> rest = joints_of(source.rig);
  for (const char* finest : {"source", "samples"}) {
    const Outcome built = run({"build", test_asset("worm.glb"), "-o", path(finest), "--finest", finest, "--map-size",
                               "512", "--no-preview", "-q"});
    ASSERT_EQ(built.code, 0) << built.err;
    const Asset asset = read_asset(path(std::string(finest) + "/worm.glb"));
    ASSERT_GT(asset.levels.size(), 1U);
    for (const AssetLevel& level : {asset.levels[0], asset.levels[1]}) {
      const CompareOptions options{.points = 20'000};
      const double at_rest =
          compare(posed(source, rest, rest).view(), posed(level, rest).view(), options).mean_percent();
      std::mt19937 random(1);
      for (int i = 0; i < 5; ++i) {
        const std::vector<M44d> joints = joints_of(posed_at_random(source.rig, random));
        const double in_pose =
            compare(posed(source, rest, joints).view(), posed(level, joints).view(), options).mean_percent();
        // Weights between vertices bend what is straight between them: by less than a hundredth of a percent.
        EXPECT_LE(in_pose, 1.5 * at_rest + 0.01) << finest << ", " << level.triangles.size() << " triangles";
      }
    }
  }
}

/// The mean distance between the source and a level, in percent of the diagonal.
double distance(const SourceMesh& source, const AssetLevel& level) {
  const AssetLevel stands = at_rest(level);
  return compare({source.positions, source.triangles}, {stands.positions, stands.triangles}, {.points = 20'000})
      .mean_percent();
}

TEST_F(Poses, OfAnimationsMoveEachLevelAsTheyMoveTheSource) {
  const std::map<std::string, std::string> assets{
      {"face", "quantized"}, {"packed_worms", "quantized"}, {"cart", "float"}};
  for (const auto& [name, vertices] : assets) {
    const SourceMesh source = import_surface(test_asset(name + ".glb"));
    const Outcome built = run({"build", test_asset(name + ".glb"), "-o", path("out"), "--finest", "samples", "--maps",
                               "normal", "--map-size", "512", "--no-preview", "-q", "--vertex-format", vertices,
                               "--compress", vertices == "float" ? "none" : "meshopt"});
    ASSERT_EQ(built.code, 0) << built.err;
    EXPECT_EQ(run({"check", path("out/" + name + ".glb")}).code, 0) << name;
    const Asset asset = read_asset(path("out/" + name + ".glb"));
    ASSERT_EQ(asset.rig.animations.size(), source.rig.animations.size()) << name;
    for (std::size_t l = 0; l < 2; ++l) {
      const double rest = distance(source, asset.levels[l]);
      for (const Pose& pose : sample_poses(source.rig, 4, 2)) {
        const double in_this = distance(in_pose(source, pose), in_pose(asset, pose, name).levels[l]);
        EXPECT_LE(in_this, 1.5 * rest + 0.01) << name << ", level " << l << ", animation " << pose.animation;
      }
    }
  }
}

TEST_F(Poses, AreMeasuredAndDrawnOnRequest) {
  const Outcome built = run({"build", test_asset("face.glb"), "-o", path("out"), "--maps", "normal", "--map-size",
                             "512", "-q", "--report", path("report.json")});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_NE(read_text(path("report.json")).find("worst_mean_percent"), std::string::npos);
  const Outcome same = run({"compare", test_asset("face.glb"), path("out/face.glb"), "--time", "1", "--json"});
  ASSERT_EQ(same.code, 0) << same.err;
  // The source's own triangles.
  EXPECT_LT(nlohmann::json::parse(same.out)["mean_percent"].get<double>(), 1e-4);
  const Outcome other =
      run({"compare", test_asset("face.glb"), path("out/face.glb"), "--time", "1", "--animation", "3"});
  EXPECT_EQ(other.code, 2) << other.err;
  EXPECT_EQ(run({"render", path("out/face.glb"), "-o", path("a.png"), "--width", "64", "--height", "64"}).code, 0);
  EXPECT_EQ(
      run({"render", path("out/face.glb"), "-o", path("b.png"), "--width", "64", "--height", "64", "--time", "1"}).code,
      0);
  EXPECT_NE(read_text(path("a.png")), read_text(path("b.png")));
}

}  // namespace
}  // namespace lozenge::end_to_end
