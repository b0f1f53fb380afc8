#include "tools/bench/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "tools/bench/bench_mesh.h"

namespace lozenge::bench {
namespace {

class MeshFile : public testing::Test {
 protected:
  fixtures::TestFolder folder_;

  Surface read(const char* name, const std::string& content) const {
    fixtures::write_bytes(folder_ / name, content);
    return read_mesh(folder_ / name);
  }

  /// What is wrong with it; empty where nothing is.
  std::string complaint(const char* name, const std::string& content, ExitCode code = ExitCode::kUnusableInput) const {
    try {
      read(name, content);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
  }

  void expect_refused(const char* name, const std::string& content, const std::string& word) const {
    const std::string message = complaint(name, content);
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
};

bool same(const Surface& a, const Surface& b) { return a.positions == b.positions && a.triangles == b.triangles; }

const std::vector<Vec3f> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};

/// A square of two triangles.
void expect_square(const Surface& mesh) {
  EXPECT_EQ(mesh.positions, kSquare);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangles[0], (std::array<VertexId, 3>{0, 1, 2}));
  EXPECT_EQ(mesh.triangles[1], (std::array<VertexId, 3>{0, 2, 3}));
}

// ---- OFF

TEST_F(MeshFile, OffMayHaveCommentsColoursNormalsAndPolygons) {
  expect_square(read("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n4 0 1 2 3\n"));
  expect_square(read("a.off", "OFF 4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 5e-1\r\n4 0 1 2 3\r\n"));
  expect_square(
      read("a.off",
           "# made by hand\nCOFF # colours\n4 2\n\n0 0 0 1 0 0 1 #red\n+1 0 0 0 0 0\n1 1 0\n\n0 1 .5 255 0 0 255\n"
           "3 0 1 2 1 0 0\n3 0 2 3 # the last"));
  expect_square(read("a.off", "NOFF\n4 2 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0.5 0 0 1\n3 0 1 2\n3 0 2 3"));
}

TEST_F(MeshFile, OffSkipsPointsAndLinesAmongItsFaces) {
  expect_square(read("a.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n1 3\n4 0 1 2 3\n2 0 1\n"));
}

TEST_F(MeshFile, RefusesBrokenOff) {
  expect_refused("a.off", "", "is empty");
  expect_refused("a.off", "\n\n# nothing\n", "begin with OFF");
  expect_refused("a.off", "ply\n", "begin with OFF");
  expect_refused("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n", "line 5: the file ends where a coordinate");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 zero 0\n1 1 0\n3 0 1 2\n", "line 4: a coordinate is 'zero'");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 nan\n3 0 1 2\n", "isn't finite");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 1e39\n3 0 1 2\n", "isn't finite");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n", "names vertex 3, but there are 3");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 -1\n", "names vertex -1");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n-3 0 1 2\n", "less than nothing");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n9000000000000000000 0 1 2\n", "the file ends");
  expect_refused("a.off", "OFF\n9000000000000000000 1 0\n0 0 0\n", "the file ends");
  expect_refused("a.off", "OFF\n-1 1 0\n0 0 0\n", "less than nothing");
  expect_refused("a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n1 1 0\n", "3 vertices, but no triangles");
  expect_refused("a.off", "OFF\n0 0 0\n", "no triangles");
}

TEST_F(MeshFile, SaysWhichKindsOfOffItDoesNotTake) {
  EXPECT_NE(complaint("a.off", "OFF BINARY\n\0\0\0\4", ExitCode::kUnsupported).find("ASCII"), std::string::npos);
  EXPECT_NE(complaint("a.off", "4OFF\n1 0 0\n0 0 0 1\n", ExitCode::kUnsupported).find("three"), std::string::npos);
}

// ---- OBJ

TEST_F(MeshFile, ObjMayNameVerticesInEveryWay) {
  const std::string vertices = "# a square\no square\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvn 0 0 1\n";
  expect_square(read("a.obj", vertices + "f 1 2 3 4\n"));
  expect_square(read("a.obj", vertices + "f -4 -3 -2 -1"));
  expect_square(read("a.obj", vertices + "s off\nf 1/1 2/1 3/1\nf 1//1 3//1 4//1\n"));
  expect_square(read("a.obj", vertices + "f 1/1/1 2/1/1 \\\n 3/1/1 4/1/1\n"));
  expect_square(read("a.obj", "f 1 2 3 4\n" + vertices));
}

TEST_F(MeshFile, RefusesBrokenObj) {
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1\nf 1 2 3\n", "line 3: a coordinate");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n", "names vertex 3, but there are 3");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -1 -2 -4\n", "names vertex -1");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n", "line 4: '0' is no corner");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf a b c\n", "'a' is no corner");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\n", "no triangles");
  expect_refused("a.obj", "hello\n", "no triangles");
}

// ---- PLY

template <typename T>
std::string bytes_of(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// The square with other properties before, between and after those that count.
template <typename Coordinate, typename Count, typename Index>
std::string binary_square(bool big_endian, const std::string& coordinate, const std::string& count,
                          const std::string& index) {
  std::string ply = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") + "_endian 1.0\n" +
                    "comment a square\nelement vertex 4\nproperty uchar red\nproperty " + coordinate + " x\nproperty " +
                    coordinate + " y\nproperty list uchar short odd\nproperty " + coordinate +
                    " z\nelement edge 1\nproperty int vertex1\nelement face 1\nproperty float quality\n" +
                    "property list " + count + " " + index + " vertex_indices\nproperty list uint8 float32 uv\n" +
                    "end_header\n";
  for (const Vec3f& p : kSquare) {
    ply += '\x7f' + bytes_of(static_cast<Coordinate>(p.x), big_endian) +
           bytes_of(static_cast<Coordinate>(p.y), big_endian);
    ply += '\2' + bytes_of<std::int16_t>(7, big_endian) + bytes_of<std::int16_t>(8, big_endian);
    ply += bytes_of(static_cast<Coordinate>(p.z), big_endian);
  }
  ply += bytes_of<std::int32_t>(1, big_endian) + bytes_of(0.5F, big_endian) + bytes_of<Count>(4, big_endian);
  for (Index i = 0; i < 4; ++i) ply += bytes_of(i, big_endian);
  return ply + '\1' + bytes_of(0.25F, big_endian);
}

TEST_F(MeshFile, PlyMayBeBinaryOfEitherByteOrderAndOfAnyType) {
  for (const bool big : {false, true}) {
    expect_square(read("a.ply", binary_square<float, std::uint8_t, std::int32_t>(big, "float", "uchar", "int")));
    expect_square(read("a.ply", binary_square<double, std::int8_t, std::uint32_t>(big, "float64", "int8", "uint32")));
    expect_square(read("a.ply", binary_square<double, std::uint16_t, std::int16_t>(big, "double", "ushort", "int16")));
    expect_square(read("a.ply", binary_square<float, std::uint32_t, std::uint8_t>(big, "float32", "uint", "uchar")));
  }
}

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

TEST_F(MeshFile, PlyMayBeText) {
  expect_square(read("a.ply", kPlyHeader + "element face 2\nproperty list uchar int vertex_index\nend_header\n"
                                           "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n"));
}

TEST_F(MeshFile, RefusesEveryTruncationOfAPly) {
  const std::string whole = binary_square<float, std::uint8_t, std::int32_t>(false, "float", "uchar", "int");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(complaint("a.ply", whole.substr(0, size)), "") << size;
  }
}

TEST_F(MeshFile, RefusesBrokenPly) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  expect_refused("a.ply", "OFF\n", "begin with ply");
  expect_refused("a.ply", "ply\nformat utf8 1.0\n", "no format 'utf8'");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nproperty float x\n", "belongs to no element");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex many\n", "'many' is no number");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "no type 'real'");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", "no end");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
                 "no x, y and z");
  expect_refused("a.ply", kPlyHeader + faces + vertices + "3 0 1 4\n", "names vertex 4, but there are 4");
  expect_refused("a.ply", kPlyHeader + faces + vertices + "3 0 1 0.5\n", "vertex_indices is 0.5");
  expect_refused("a.ply", kPlyHeader + faces + vertices + "-1 0 1 2\n", "vertex_indices is -1");
  expect_refused("a.ply", kPlyHeader + faces + vertices + "3 0 1\n", "the file ends");
  expect_refused("a.ply", kPlyHeader + "end_header\n" + vertices, "no triangles");
  // Elements without properties take no bytes, however many there are.
  expect_refused("a.ply", kPlyHeader + "element nothing 9000000000000000000\nend_header\n" + vertices, "no triangles");
}

// ---- STL

const std::string kFacets =
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 1 1 0\n endloop\nendfacet\n"
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 1 0\n vertex 0 1 0.5\n endloop\nendfacet\n";

std::string binary_stl_square() {
  std::string bytes = "solid, although it is binary";
  bytes.resize(80, ' ');
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  add(std::uint32_t{2});
  for (const auto& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    add(Vec3f(0, 0, 1));
    for (const int corner : triangle) add(kSquare[corner]);
    add(std::uint16_t{0});
  }
  return bytes;
}

TEST_F(MeshFile, StlMayBeTextOrBinary) {
  const std::string text = "solid a square of two triangles\n" + kFacets + "endsolid a square\n";
  for (const std::string& content : {text, binary_stl_square()}) {
    const Surface mesh = read("a.stl", content);
    EXPECT_EQ(mesh.positions.size(), 6U);
    expect_square(welded(mesh));
  }
}

TEST_F(MeshFile, RefusesBrokenStl) {
  expect_refused("a.stl", "facet", "neither a text that begins with 'solid'");
  expect_refused("a.stl", "solid\nsphere 1\n", "'sphere' stands where a facet should");
  expect_refused("a.stl", "solid\nfacet\nouter loop\nvertex 0 0\nendloop", "line 5");
  expect_refused("a.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nendloop", "'vertex' was expected");
  expect_refused("a.stl", "solid\nendsolid\n", "no triangles");
  const std::string whole = binary_stl_square();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(complaint("a.stl", whole.substr(0, size)), "") << size;
  }
}

// ---- Writing

TEST_F(MeshFile, GlbAndOffGiveTheSameMeshBack) {
  const Surface sphere = sphere_mesh(500);
  write_mesh(folder_ / "s.off", sphere);
  EXPECT_TRUE(same(read_mesh(folder_ / "s.off"), sphere));
  // A GLB is read through the importer, which numbers vertices in the order of the corners: as welded() does.
  write_mesh(folder_ / "s.glb", sphere);
  EXPECT_TRUE(same(read_mesh(folder_ / "s.glb"), welded(sphere)));
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
