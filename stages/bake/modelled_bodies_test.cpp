#include "stages/bake/modelled_bodies.h"

#include <gtest/gtest.h>

#include <array>

#include "stages/bake/occlusion.h"

namespace lozenge {
namespace {

void add_tetrahedron(SourceMesh& mesh, float size, std::int32_t material) {
  const auto first = static_cast<VertexId>(mesh.positions.size());
  for (const Vec3f& p : {Vec3f(1, 1, 1), Vec3f(-1, -1, 1), Vec3f(-1, 1, -1), Vec3f(1, -1, -1)}) {
    mesh.positions.push_back(p * size);
  }
  for (const auto& [a, b, c] : {std::array{0, 1, 3}, std::array{0, 2, 1}, std::array{0, 3, 2}, std::array{1, 2, 3}}) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.materials.push_back(material);
  }
}

/// A tetrahedron that stands still, and a small one inside of it, which a node made small and may move out.
SourceMesh one_in_another() {
  SourceMesh mesh;
  mesh.material_names = {"outer", "inner"};
  add_tetrahedron(mesh, 10, 0);
  add_tetrahedron(mesh, 0.1F, 1);
  mesh.rig.nodes.push_back({"inner", -1, {}, {}, {}, {0.1, 0.1, 0.1}});
  const Placement small{0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 1};
  mesh.bodies = {{{"inner", {{small, 0}}, -1}}, {-1, 0}};
  return mesh;
}

TEST(ModelledBodies, HideNothingOfEachOther) {
  const SourceMesh mesh = one_in_another();
  const ModelledBodies bodies(mesh);
  const SourcePoint inner{5, Vec3d(1.0 / 3, 1.0 / 3, 1.0 / 3)};
  const OcclusionPoint point = bodies.at(inner);
  EXPECT_NEAR(point.position.length(), 1 / std::sqrt(3.0), 1e-6) << "as large as it was modelled";
  EXPECT_NEAR(bodies.unit_of(5), 10, 1e-4);
  EXPECT_EQ(bodies.unit_of(0), 1);
  std::int64_t rays = 0;
  EXPECT_EQ(openness(bodies.scene_of(5), point, {64, 1e-4, 1e9}, 1, rays), 1);
  const RayScene at_rest(mesh.positions, mesh.triangles);
  const OcclusionPoint stands{Vec3d(position_at(mesh, inner)), point.face_normal, point.shading_normal};
  EXPECT_EQ(openness(at_rest, stands, {64, 1e-6, 1e9}, 1, rays), 0);
}

}  // namespace
}  // namespace lozenge
