#include "formats/files/readers/ply.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "formats/files/readers/reader_fixtures.h"

namespace lozenge {
namespace {

using namespace fixtures;

class Ply : public ReaderTest {};

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
                    "comment a square\nelement vertex 4\nproperty uchar hardness\nproperty " + coordinate +
                    " x\nproperty " + coordinate + " y\nproperty list uchar short odd\nproperty " + coordinate +
                    " z\nelement edge 1\nproperty int vertex1\nelement face 1\nproperty float quality\n" +
                    "property list " + count + " " + index + " vertex_indices\nproperty list uint8 float32 weights\n" +
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

TEST_F(Ply, MayBeBinaryOfEitherByteOrderAndOfAnyType) {
  for (const bool big : {false, true}) {
    expect_square(read("a.ply", binary_square<float, std::uint8_t, std::int32_t>(big, "float", "uchar", "int")));
    expect_square(read("a.ply", binary_square<double, std::int8_t, std::uint32_t>(big, "float64", "int8", "uint32")));
    expect_square(read("a.ply", binary_square<double, std::uint16_t, std::int16_t>(big, "double", "ushort", "int16")));
    expect_square(read("a.ply", binary_square<float, std::uint32_t, std::uint8_t>(big, "float32", "uint", "uchar")));
  }
}

const std::string kVertices =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFace = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kData = "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n";

std::string with_line_ends(const std::string& text, const std::string& line_end) {
  std::string changed;
  for (const char c : text) changed += c == '\n' ? line_end : std::string(1, c);
  return changed;
}

TEST_F(Ply, MayBeTextWithAnyLineEndsAndWhiteSpace) {
  expect_square(read("a.ply", kVertices + "element face 2\nproperty list uchar int vertex_index\nend_header\n"
                                          "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n3 0 1 2\n3 0 2 3\n"));
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    expect_square(
        read("a.ply", with_line_ends(kVertices + "comment # by hand\nobj_info 7\n" + kFace + kData, line_end)));
  }
  expect_square(read("a.ply", kVertices + kFace + "\t0 0 0   1\t0 0\n\n1 1 0 0 1 0.5 4 0 1\n2 3"));
  expect_square(read("no.ending", kVertices + kFace + kData));
}

TEST_F(Ply, FindsBytesBehindAHeaderOfAnyLineEnds) {
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    std::string header = with_line_ends(
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
        "z\n" +
            kFace,
        line_end);
    for (const Vec3f& p : kSquare) header += bytes_of(p.x, false) + bytes_of(p.y, false) + bytes_of(p.z, false);
    header += '\4';
    for (std::int32_t i = 0; i < 4; ++i) header += bytes_of(i, false);
    expect_square(read("a.ply", header));
  }
}

TEST_F(Ply, FacesMayComeBeforeVertices) {
  expect_square(read("a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n" +
                                  kVertices.substr(kVertices.find("element")) +
                                  "end_header\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n"));
}

TEST_F(Ply, GivesNormalsColoursAndTextureCoordinates) {
  const std::string data =
      "0 0 1 255 128 0 51 0 0 0 0 1\n1 0 0 0 0 0 255 1 0 0 1 .25\n0 1 0 255 255 255 255 1 1 0 .5 0\n3 0 1 2\n";
  for (const auto& [u, v] : {std::pair("s", "t"), std::pair("u", "v"), std::pair("texture_u", "texture_v")}) {
    const Primitive mesh =
        read("a.ply", std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\n"
                                  "property float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                                  "property uchar alpha\nproperty float x\nproperty float y\nproperty float z\n") +
                          "property float " + u + "\nproperty float " + v + "\n" + kFace + data);
    EXPECT_EQ(positions_of(mesh), (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    EXPECT_EQ(values_of(mesh, kNormals), (std::vector<float>{0, 0, 1, 1, 0, 0, 0, 1, 0}));
    EXPECT_EQ(values_of(mesh, kTextureCoordinates), (std::vector<float>{0, 0, 1, 0.75F, 0.5F, 1})) << "v runs down";
    expect_near(values_of(mesh, kColors), {1, kHalfGray, 0, 0.2F, 0, 0, 0, 1, 1, 1, 1, 1});
  }
}

TEST_F(Ply, ColoursMayBeFloatsAndLackAlpha) {
  const Primitive mesh =
      read("a.ply", kVertices + "property float red\nproperty float green\nproperty float blue\n" + kFace +
                        "0 0 0 1 0.5019608 0\n1 0 0 0 0 0\n1 1 0 1 1 1\n0 1 0.5 0 0 1\n4 0 1 2 3\n");
  expect_square(mesh);
  expect_near(values_of(mesh, kColors), {1, kHalfGray, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1, 0, 0, 1, 1});
}

TEST_F(Ply, CornersMayHaveTextureCoordinatesOfTheirOwn) {
  const Primitive mesh = read("a.ply", kVertices +
                                           "element face 2\nproperty list uchar int vertex_indices\n"
                                           "property list uchar float texcoord\nend_header\n"
                                           "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n"
                                           "3 0 1 2 6 0 1 .5 1 .5 .5\n3 0 2 3 6 0 1 .25 .75 0 0\n");
  EXPECT_EQ(corner_values(mesh, kTextureCoordinates),
            (std::vector<float>{0, 0, 0.5F, 0, 0.5F, 0.5F, 0, 0, 0.25F, 0.25F, 0, 1}));
}

TEST_F(Ply, RefusesEveryTruncation) {
  const std::string whole = binary_square<float, std::uint8_t, std::int32_t>(false, "float", "uchar", "int");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(complaint("a.ply", whole.substr(0, size)), "") << size;
  }
}

TEST_F(Ply, IsRefusedWithTheLineWhereItIsBroken) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  expect_refused("a.ply", "plz\n", "begin with 'ply'");
  expect_refused("a.ply", "ply\nformat utf8 1.0\n", "line 2: there is no format 'utf8'");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nproperty float x\n", "line 3: a property belongs to no element");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex many\n", "line 3: 'many' is no number");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n", "'-1' is no number");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n", "no type 'real'");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n", "fractions");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", "no end");
  expect_refused("a.ply", "ply\nelement vertex 1\nproperty float x\nend_header\n0\n", "doesn't say which format");
  expect_refused("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
                 "no x, y and z");
  expect_refused("a.ply", "ply\nteapot\n", "line 2: 'teapot' is nothing");
  expect_refused("a.ply", kVertices + kFace + vertices + "3 0 1 4\n",
                 "line 14: a face names vertex 4, but there are 4");
  expect_refused("a.ply", kVertices + kFace + vertices + "3 0 1 -1\n", "line 14: a face names vertex -1");
  expect_refused("a.ply", kVertices + kFace + vertices + "3 0 1 0.5\n", "line 14: vertex_indices is 0.5");
  expect_refused("a.ply", kVertices + kFace + vertices + "3 0 1 nan\n", "vertex_indices is nan");
  expect_refused("a.ply", kVertices + kFace + vertices + "-1 0 1 2\n", "vertex_indices is -1");
  expect_refused("a.ply", kVertices + kFace + vertices + "3 0 1\n", "the file ends");
  expect_refused("a.ply", kVertices + kFace + "0 0 0\n1 x 0\n" + vertices, "line 11: y is 'x', which is no number");
  expect_refused("a.ply", kVertices + kFace + "0 0 0\n1 0 inf\n" + vertices,
                 "line 11: the position of vertex 1 is not finite");
  expect_refused("a.ply", kVertices + "end_header\n" + vertices, "4 vertices, but no triangles");
  // Elements without properties take no bytes, however many there are.
  expect_refused("a.ply", kVertices + "element nothing 9000000000000000000\nend_header\n" + vertices, "no triangles");
}

TEST_F(Ply, IsRefusedWithTheByteWhereItsDataAreBroken) {
  std::string whole = binary_square<float, std::uint8_t, std::int32_t>(false, "float", "uchar", "int");
  const std::size_t data = whole.find("end_header\n") + 11;
  std::string endless = whole;
  endless.replace(data + 1, 4, bytes_of(std::numeric_limits<float>::infinity(), false));
  expect_refused("a.ply", endless, "byte " + std::to_string(data) + ": the position of vertex 0 is not finite");
  std::string past = whole;
  past.replace(whole.size() - 9, 4, bytes_of<std::int32_t>(4, false));
  expect_refused("a.ply", past,
                 "byte " + std::to_string(data + 4 * 18 + 4) + ": a face names vertex 4, but there are 4");
}

TEST_F(Ply, IsRefusedBeforeMemoryIsTakenForWhatTheFileCannotHold) {
  const std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
      "property float y\nproperty float z\n" +
      kFace;
  expect_refused("a.ply", binary + "0000", "promises 4000000000 of the element 'vertex', more than the 4 bytes");
  expect_refused(
      "a.ply",
      kVertices + "element face 9000000000000000000\nproperty list uchar int vertex_indices\nend_header\n" + kData,
      "of the element 'face'");
  expect_refused("a.ply", kVertices + kFace + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2000000000 0 1 2\n",
                 "line 14: vertex_indices is 2000000000, more than");
  const std::string list = binary_square<float, std::uint32_t, std::int32_t>(false, "float", "uint", "int");
  std::string huge = list;
  huge.replace(list.size() - 25, 4, "\xff\xff\xff\xff");
  expect_refused("a.ply", huge, "vertex_indices has 4294967295 values, more than the 21 bytes");
}

TEST_F(Ply, KeepsToTheLimits) {
  const std::string square = kVertices + kFace + kData;
  EXPECT_EQ(complaint("a.ply", square, ExitCode::kLimit, {.max_triangles = 2}), "");
  EXPECT_NE(complaint("a.ply", square, ExitCode::kLimit, {.max_triangles = 1}).find("--max-triangles"),
            std::string::npos);
  EXPECT_NE(complaint("a.ply", square, ExitCode::kLimit, {.max_memory = 500}).find("reading its 4 vertices"),
            std::string::npos);
}

}  // namespace
}  // namespace lozenge
