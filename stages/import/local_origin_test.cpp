// Surfaces far from the scene's origin keep what they have.
#include "stages/import/local_origin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/files/source_mesh_file.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

/// Positions that are no round numbers.
TestGltf odd_tetrahedron() {
  TestGltf gltf;
  std::vector<Vec3f> positions = tetrahedron_positions();
  for (Vec3f& p : positions) p = p * 10.1F + Vec3f(0.017F, 0.3F, 1.9F);
  gltf.add_simple_mesh(positions, tetrahedron_indices());
  return gltf;
}

class LocalOrigin : public testing::Test {
 protected:
  SourceMesh import(TestGltf gltf) {
    write_bytes(folder_ / "a.glb", gltf.glb());
    return import_surface(folder_ / "a.glb");
  }

  fixtures::TestFolder folder_;
};

TEST_F(LocalOrigin, OfAMeshThatANodeTakesFarAwayLeavesItsPositionsAsTheyAre) {
  const SourceMesh near = import(odd_tetrahedron());
  EXPECT_EQ(near.translation, Vec3d(0, 0, 0));
  TestGltf far = odd_tetrahedron();
  far.document["nodes"][0]["translation"] = {449123.37, 121.5, -5410987.62};
  const SourceMesh mesh = import(far);
  EXPECT_EQ(mesh.translation, Vec3d(449123.37, 121.5, -5410987.62));
  EXPECT_TRUE(same_bits(mesh.positions, near.positions));
}

TEST_F(LocalOrigin, IsTheScenesWhereThatIsNear) {
  TestGltf near = odd_tetrahedron();
  near.document["nodes"][0]["translation"] = {300, 0, 0};
  const SourceMesh mesh = import(near);
  EXPECT_EQ(mesh.translation, Vec3d(0, 0, 0));
  EXPECT_GT(bounds_of(mesh.positions).low.x, 280);
}

TEST_F(LocalOrigin, IsKeptByTheFilesOfMeshes) {
  TestGltf far = odd_tetrahedron();
  far.document["nodes"][0]["translation"] = {449123.37, 121.5, -5410987.62};
  const SourceMesh mesh = import(far);
  write_source_mesh(folder_ / "mesh.glb", mesh);
  for (const SourceMesh& again : {read_source_mesh(folder_ / "mesh.glb"), import_surface(folder_ / "mesh.glb")}) {
    EXPECT_EQ(again.translation, mesh.translation);
    expect_same_mesh(again, mesh);
  }
}

TEST_F(LocalOrigin, IsARoundNumberWhereCoordinatesThemselvesAreLarge) {
  write_bytes(folder_ / "far.obj", "v 500001 1000 4000001\nv 500009 1000 4000001\nv 500001 1008 4000001\nf 1 2 3\n");
  const SourceMesh mesh = import_surface(folder_ / "far.obj");
  EXPECT_NEAR(mesh.translation.x, 500005, 16);
  EXPECT_EQ(std::fmod(mesh.translation.x, 16), 0);
  EXPECT_EQ(mesh.translation.x + mesh.positions[0].x, 500001);
  EXPECT_LT(diagonal(bounds_of(mesh.positions)), 12);
}

TEST_F(LocalOrigin, IsNotWhereAFileSaysFalsely) {
  TestGltf gltf = odd_tetrahedron();
  gltf.document["accessors"][0]["min"] = {1e8, 1e8, 1e8};
  gltf.document["accessors"][0]["max"] = {1e8, 1e8, 1e8};
  EXPECT_EQ(import(gltf).translation, Vec3d(0, 0, 0));
}

}  // namespace
}  // namespace lozenge
