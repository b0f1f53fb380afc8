// Meshes that a scene places more than once, nodes that move, skins: which of the placements become surface.
#include "stages/import/find_bodies.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/files/source_mesh_file.h"
#include "formats/surface/body_fixtures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

struct Imported {
  SourceMesh mesh;
  ImportReport report;
};

class RepeatedMeshImport : public testing::Test {
 protected:
  Imported import(TestGltf gltf, Instances instances = Instances::kShared) const {
    write_bytes(folder_ / "asset.glb", gltf.glb());
    Imported made;
    made.mesh = import_surface(folder_ / "asset.glb", {.instances = instances, .fill_holes = 0}, {}, &made.report);
    return made;
  }

  fixtures::TestFolder folder_;
};

/// A tetrahedron, alone so far.
TestGltf with_nodes(const std::vector<json>& nodes) {
  TestGltf gltf = tetrahedron();
  gltf.document["meshes"][0]["name"] = "stone";
  gltf.document["nodes"] = json::array();
  for (json node : nodes) {
    node["mesh"] = 0;
    gltf.add_node(node);
  }
  return gltf;
}

TEST_F(RepeatedMeshImport, BecomesOneSurfaceAndCopiesThatStandWhereItsPlacementsDo) {
  const double h = std::sqrt(0.5);
  const std::vector<json> nodes = {{{"translation", {9, 0, 0}}, {"rotation", {h, 0, 0, h}}, {"scale", {2, 2, 2}}},
                                   {{"translation", {0, 9, 0}}},
                                   {{"translation", {0, 0, 9}}, {"scale", {1, 2, 3}}},
                                   {{"translation", {-9, 0, 0}}, {"rotation", {0, h, h, 0}}, {"scale", {1, 1, -1}}}};
  const Imported shared = import(with_nodes(nodes));
  ASSERT_EQ(shared.mesh.triangles.size(), 4U);
  ASSERT_EQ(shared.mesh.bodies.bodies.size(), 1U);
  EXPECT_EQ(shared.mesh.bodies.bodies[0].name, "stone");
  EXPECT_EQ(shared.report.copies, 3);
  EXPECT_EQ(
      shared.report.notes.at(0),
      "4 placements of meshes that are placed more than once; 3 of them only place the surface of another one again");
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const Placement copy = copies_of(shared.mesh.bodies.bodies[0]).at(n - 1);
    const Imported alone = import(with_nodes({nodes[n]}));
    const bool mirrors = is_mirroring(copy);
    EXPECT_EQ(mirrors, n == 3);
    for (std::size_t t = 0; t < 4; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3f moved = placed(copy, shared.mesh.positions[shared.mesh.triangles[t][c]]);
        const std::size_t other = mirrors ? (3 - c) % 3 : c;
        EXPECT_LT((moved - alone.mesh.positions[alone.mesh.triangles[t][other]]).length(), 1e-5F);
      }
    }
  }
  EXPECT_EQ(import(with_nodes(nodes), Instances::kSeparate).mesh.triangles.size(), 16U);
  EXPECT_TRUE(import(with_nodes(nodes), Instances::kSeparate).mesh.bodies.empty());
}

TEST_F(RepeatedMeshImport, StaysSurfaceOfItsOwnWhereItTouchesAnotherOne) {
  // The second one's corner lies on one of the first; the fourth is a copy of the third.
  const Imported made = import(with_nodes(
      {{{"name", "a"}}, {{"translation", {2, 2, 0}}}, {{"translation", {9, 0, 0}}}, {{"translation", {18, 0, 0}}}}));
  EXPECT_EQ(made.mesh.triangles.size(), 12U);
  EXPECT_EQ(made.report.copies, 1);
  ASSERT_EQ(made.mesh.bodies.bodies.size(), 1U);
  ASSERT_EQ(made.mesh.bodies.bodies[0].places.size(), 2U);
  EXPECT_EQ(made.mesh.bodies.bodies[0].places[1].placement[12], 9);
  for (std::size_t t = 0; t < 12; ++t) {
    const bool is_third = made.mesh.positions[made.mesh.triangles[t][0]].x > 5;
    EXPECT_EQ(made.mesh.bodies.owner_of(made.mesh.materials[t]), is_third ? 0 : -1);
  }
  // Two in one place are two layers of one surface, as they are without any sharing.
  const std::vector<json> twice = {{{"name", "a"}}, {{"name", "b"}}};
  expect_same_mesh(import(with_nodes(twice)).mesh, import(with_nodes(twice), Instances::kSeparate).mesh);
}

TEST_F(RepeatedMeshImport, StaysSurfaceOfItsOwnWhereNoNodeCouldPlaceIt) {
  // Stretched after it was turned: no rotation and scale takes the first there.
  TestGltf gltf = with_nodes({{{"name", "a"}}, {{"rotation", {0.6, 0, 0, 0.8}}}});
  gltf.add_node({{"translation", {9, 0, 0}}, {"scale", {1, 1, 3}}, {"children", {1}}});
  const Imported made = import(gltf);
  EXPECT_EQ(made.mesh.triangles.size(), 8U);
  EXPECT_TRUE(made.mesh.bodies.empty());
  EXPECT_EQ(made.report.notes.at(0),
            "2 placements of meshes that are placed more than once; each becomes surface of its own");
  // A first one without volume can't be undone.
  const Imported flat = import(with_nodes({{{"scale", {1, 1, 0}}}, {{"translation", {9, 0, 0}}}}));
  EXPECT_TRUE(flat.mesh.bodies.empty());
}

TEST_F(RepeatedMeshImport, KeepsMaterialsApartAndWhatTheySay) {
  TestGltf gltf = with_nodes({{{"name", "a"}}, {{"translation", {9, 0, 0}}}});
  gltf.document["materials"] = {{{"name", "moss"}}, {{"name", "leaf"}, {"doubleSided", true}}};
  gltf.document["meshes"][0]["primitives"][0]["material"] = 1;
  gltf.add_simple_mesh({{1, 1, 21}, {-1, -1, 21}, {-1, 1, 19}, {1, -1, 19}}, tetrahedron_indices());
  gltf.document["meshes"][1]["primitives"][0]["material"] = 1;
  const SourceMesh mesh = import(gltf).mesh;
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"moss", "leaf", "leaf"}));
  EXPECT_EQ(mesh.double_sided, (std::vector<bool>{false, true, true}));
  EXPECT_EQ(mesh.bodies.owner, (std::vector<std::int32_t>{-1, -1, 0}));
  EXPECT_EQ(mesh.materials, (std::vector<std::int32_t>{1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST_F(RepeatedMeshImport, IsKeptByTheSurfacesOwnFile) {
  TestGltf gltf = with_nodes({{{"name", "a"}}, {{"translation", {9, 0, 0}}, {"rotation", {0.6, 0, 0, 0.8}}}});
  // Open, and filled: the cap belongs to the repeated mesh, too.
  gltf.document["accessors"][1]["count"] = 9;
  write_bytes(folder_ / "asset.glb", gltf.glb());
  const SourceMesh mesh = import_surface(folder_ / "asset.glb", {.fill_holes = 1000});
  ASSERT_EQ(mesh.cap_of.size(), mesh.material_names.size());
  EXPECT_EQ(mesh.bodies.owner, (std::vector<std::int32_t>{0, 0}));
  write_source_mesh(folder_ / "once.glb", mesh);
  const SourceMesh again = import_surface(folder_ / "once.glb", {.fill_holes = 1000});
  expect_same_mesh(mesh, again);
  fixtures::expect_same(mesh.bodies, again.bodies);
  EXPECT_EQ(mesh.cap_of, again.cap_of);
}

}  // namespace
}  // namespace lozenge
