#include "tools/bench/mesh_file.h"

#include <gtest/gtest.h>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "tools/bench/bench_mesh.h"

namespace lozenge::bench {
namespace {

class MeshFile : public testing::Test {
 protected:
  fixtures::TestFolder folder_;
};

bool same(const Surface& a, const Surface& b) { return a.positions == b.positions && a.triangles == b.triangles; }

TEST_F(MeshFile, GlbAndOffGiveTheSameMeshBack) {
  const Surface sphere = sphere_mesh(500);
  write_mesh(folder_ / "s.off", sphere);
  EXPECT_TRUE(same(read_mesh(folder_ / "s.off"), sphere));
  // A GLB is read through the importer, which numbers vertices in the order of the corners: as welded() does.
  write_mesh(folder_ / "s.glb", sphere);
  EXPECT_TRUE(same(read_mesh(folder_ / "s.glb"), welded(sphere)));
}

TEST_F(MeshFile, IsNeitherWeldedNorRepaired) {
  fixtures::write_bytes(folder_ / "twice.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 4 2 3\nf 1 1 4\n");
  const Surface mesh = read_mesh(folder_ / "twice.obj");
  EXPECT_EQ(mesh.positions.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 3U);
}

TEST_F(MeshFile, RefusesOtherEndingsAndMissingFiles) {
  EXPECT_THROW(write_mesh(folder_ / "s.stl", sphere_mesh(20)), Error);
  for (const char* name : {"missing.off", "missing.obj", "missing.ply", "missing.glb", "missing.stl"}) {
    EXPECT_THROW(read_mesh(folder_ / name), Error) << name;
  }
  std::filesystem::create_directory(folder_ / "folder.off");
  EXPECT_THROW(read_mesh(folder_ / "folder.off"), Error);
}

TEST(Welded, JoinsEqualPositionsAndDropsWhatNoTriangleUses) {
  const Surface mesh{{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                     {{1, 2, 3}, {4, 5, 6}, {1, 4, 2}}};
  const Surface joined = welded(mesh);
  EXPECT_EQ(joined.positions.size(), 4U);
  EXPECT_EQ(joined.triangles, (std::vector<std::array<VertexId, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

}  // namespace
}  // namespace lozenge::bench
