#include "formats/files/readers/stl.h"

#include "formats/files/readers/reader_fixtures.h"

namespace lozenge {
namespace {

using namespace fixtures;

class Stl : public ReaderTest {};

const std::string kFacets =
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 1 1 0\n endloop\nendfacet\n"
    "facet normal 0 0 nan\n outer loop\n vertex 0 0 0\n vertex 1 1 0\n vertex 0 1 0.5\n endloop\nendfacet\n";

std::string binary_square(const std::string& first_words) {
  std::string bytes = first_words;
  bytes.resize(80, ' ');
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  add(std::uint32_t{2});
  for (const auto& triangle : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    add(Vec3f(0, 0, 1));
    for (const int corner : triangle) add(kSquare[static_cast<std::size_t>(corner)]);
    add(std::uint16_t{0});
  }
  return bytes;
}

void expect_corners_of_square(const Primitive& mesh) {
  EXPECT_EQ(positions_of(mesh),
            (std::vector<Vec3f>{kSquare[0], kSquare[1], kSquare[2], kSquare[0], kSquare[2], kSquare[3]}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(mesh.attributes.empty());
}

TEST_F(Stl, MayBeText) {
  const std::string text = "solid a square of two triangles\n" + kFacets + "endsolid a square\n";
  expect_corners_of_square(read("a.stl", text));
  expect_corners_of_square(read("no.ending", text));
  std::string loud = "SOLID a\r\n";
  for (const char c : kFacets) {
    loud += c == '\n' ? std::string("\r\n") : std::string(1, static_cast<char>(std::toupper(c)));
  }
  expect_corners_of_square(read("a.stl", loud + "ENDSOLID\r\n"));
}

TEST_F(Stl, MayHaveSeveralSolids) {
  const Primitive mesh =
      read("a.stl", "solid\n" + kFacets + "endsolid\nsolid second\n" + kFacets + "endsolid second\n");
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

TEST_F(Stl, MayBeBinaryAndBeginAsTextDoes) {
  for (const char* words : {"", "solid, although it is binary", "COLOR=abcd"}) {
    expect_corners_of_square(read("no.ending", binary_square(words)));
    // Bytes after the last triangle, which some programs write, change its length: then its name is needed.
    expect_corners_of_square(read("a.stl", binary_square(words) + "made by hand"));
  }
}

TEST_F(Stl, IsRefusedWithTheLineOrTheByteWhereItIsBroken) {
  expect_refused("a.stl", "facet", "neither a text that begins with 'solid'");
  expect_refused("a.stl", "solid\nsphere 1\n", "line 2: 'sphere' stands where a facet should");
  expect_refused("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop",
                 "line 5: a coordinate is 'endloop'");
  expect_refused("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop",
                 "line 5: 'endloop' stands where 'vertex' is expected");
  expect_refused("a.stl",
                 "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\nvertex 0 0 1\nvertex 0 1 1\nendloop endfacet",
                 "line 2: the position of vertex 0 is not finite");
  expect_refused("a.stl", "solid\nendsolid\n", "no triangles");
  const std::string whole = binary_square("");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(complaint("a.stl", whole.substr(0, size)), "") << size;
  }
  expect_refused("a.stl", whole.substr(0, 100), "184 bytes, but there are 100");
  std::string broken = whole;
  broken[134 + 15] = '\x7f';  // the first coordinate of the second triangle
  broken[134 + 14] = '\xc0';
  expect_refused("a.stl", broken, "byte 134: the position of vertex 3 is not finite");
}

TEST_F(Stl, KeepsToTheLimits) {
  const std::string square = binary_square("");
  EXPECT_EQ(complaint("a.stl", square, ExitCode::kLimit, {.max_triangles = 2}), "");
  EXPECT_NE(complaint("a.stl", square, ExitCode::kLimit, {.max_triangles = 1}).find("--max-triangles"),
            std::string::npos);
  EXPECT_NE(complaint("a.stl", square, ExitCode::kLimit, {.max_memory = 500}).find("reading it"), std::string::npos);
}

}  // namespace
}  // namespace lozenge
