#include "formats/files/readers/obj.h"

#include "formats/files/readers/reader_fixtures.h"

namespace lozenge {
namespace {

using namespace fixtures;

class Obj : public ReaderTest {};

const std::string kVertices =
    "# a square\no square\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0.5\nvt 0 0\nvt 1 0\nvt 1 .75\nvn 0 0 1\nvn 1 0 0\n";

TEST_F(Obj, MayNameVerticesInEveryWay) {
  expect_square(read("a.obj", kVertices + "f 1 2 3 4\n"));
  expect_square(read("a.obj", kVertices + "f -4 -3 -2 -1"));
  expect_square(read("a.obj", kVertices + "f\t1  2 3  4 # all\n"));
  expect_square(read("a.obj", kVertices + "f 1 2 \\\n 3 4\n"));
  expect_square(read("a.obj", kVertices + "f 1 2\\\r\n3 4\r\n"));
  expect_square(read("a.obj", kVertices + "s off\nf 1/1 2/1 3/1\nf 1/1 3/1 4/1\n"));
  expect_square(read("a.obj", kVertices + "f 1//1 2//1 3//1\ng\nf 1//1 3//1 4//1\n"));
  expect_square(read("a.obj", kVertices + "f 1/1/1 2/2/1 3/3/1 4/1/1\n"));
  expect_square(read("a.obj", kVertices + "f 1/ 2// 3/ 4/\n"));
  expect_square(read("a.obj", "f 1 2 3 4\n" + kVertices));
  expect_square(read("no.ending", "\xEF\xBB\xBF" + kVertices + "f 1 2 3 4\n"));
}

TEST_F(Obj, GivesEachCornerItsOwnTextureCoordinatesAndNormal) {
  const Primitive mesh = read("a.obj", kVertices + "f 1/1/1 2/2/1 3/3/1\nf 1/3/2 3/-2/-1 4/1/2\n");
  EXPECT_EQ(corner_values(mesh, kTextureCoordinates), (std::vector<float>{0, 1, 1, 1, 1, 0.25F, 1, 0.25F, 1, 1, 0, 1}))
      << "v runs down";
  EXPECT_EQ(corner_values(mesh, kNormals), (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(mesh.vertices(), 6U) << "no two corners at one position agree";
}

TEST_F(Obj, CornersMayLackNormalsAndTextureCoordinates) {
  const Primitive mesh = read("a.obj", kVertices + "f 1//2 2 3/3\nf 1//2 3/3 4\n");
  EXPECT_EQ(mesh.vertices(), 4U);
  EXPECT_EQ(corner_values(mesh, kNormals), (std::vector<float>{1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(corner_values(mesh, kTextureCoordinates), (std::vector<float>{0, 0, 0, 0, 1, 0.25F, 0, 0, 1, 0.25F, 0, 0}));
  EXPECT_TRUE(read("a.obj", kVertices + "f 1 2 3\n").attributes.empty()) << "nobody names them";
}

TEST_F(Obj, ReadsColoursBehindPositions) {
  const Primitive mesh = read("a.obj", "v 0 0 0 1 0.5019608 0\nv 1 0 0 0 0 0 0.25\nv 1 1 0\nf 1 2 3\n");
  expect_near(values_of(mesh, kColors), {1, kHalfGray, 0, 1, 0, 0, 0, 0.25F, 1, 1, 1, 1});
  const Primitive bytes = read("a.obj", "v 0 0 0 255 128 0\nv 1 0 0 0 0 0\nv 1 1 0 1 1 1\nf 1 2 3\n");
  expect_near(values_of(bytes, kColors), {1, kHalfGray, 0, 1, 0, 0, 0, 1, 0.000303527F, 0.000303527F, 0.000303527F, 1});
}

TEST_F(Obj, MakesAPrimitiveOfEachMaterial) {
  const InputAsset asset =
      open("a.obj", "mtllib a.mtl\r\n" + kVertices +
                        "usemtl old stone #1\r\nf 1 2 3\r\nusemtl moss\r\nf 3 4 1\r\nusemtl unused\r\n"
                        "usemtl old stone #1\r\nf 2 3 4\r\n");
  EXPECT_EQ(asset.material_names, (std::vector<std::string>{"old stone #1", "moss", "unused"}));
  ASSERT_EQ(asset.meshes.at(0).primitives.size(), 2U);
  const Primitive stone = asset.read(0, 0);
  EXPECT_EQ(stone.material, 0);
  EXPECT_EQ(stone.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 2, 3}}));
  const Primitive moss = asset.read(0, 1);
  EXPECT_EQ(moss.material, 1);
  EXPECT_EQ(positions_of(moss), (std::vector<Vec3f>{kSquare[2], kSquare[3], kSquare[0]})) << "none that it doesn't use";
  ASSERT_EQ(asset.notes.size(), 1U);
  EXPECT_NE(asset.notes[0].find("a.mtl: there is no such file"), std::string::npos) << asset.notes[0];
  EXPECT_TRUE(asset.material_looks.empty());
}

/// A PNG of one texel.
const std::string kPicture(
    "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0\x1f\x15\xc4\x89\0\0\0\rIDAT\x78\xda\x63\x64\xf8\xcf\x50"
    "\x0f\0\3"
    "\x86\1\x80\x5a\x34\x7d\x6b\0\0\0\0IEND\xae\x42\x60\x82",
    70);

TEST_F(Obj, LooksAsItsLibrarySays) {
  write_bytes(folder_ / "old paint.png", kPicture);
  write_bytes(folder_ / "a.mtl",
              "newmtl paint\nKd 1 0.5019608 0\nd 0.25\nKe 0 0 1\nPr 0.25\nPm 1\n"
              "map_Kd -s 2 3 -clamp on -o 0.5 0.25 old paint.png\r\nnorm D:\\work\\old paint.png\n"
              "newmtl dull\nNs 30\nKd zero 0 0\nmap_Bump b.png\nmap_Ke missing.png\nmap_Kd ../outside.png\n");
  const InputAsset asset = open(
      "a.obj", "mtllib a.mtl\n" + kVertices + "usemtl paint\nf 1 2 3\nusemtl dull\nf 3 4 1\nusemtl none\nf 2 3 4\n");
  ASSERT_EQ(asset.material_looks.size(), 3U);
  const Material& paint = asset.material_looks[0];
  EXPECT_NEAR(paint.base_colour.y, kHalfGray, 1e-6) << "colours are sRGB";
  EXPECT_EQ(paint.base_colour.w, 0.25);
  EXPECT_EQ(paint.alpha_mode, AlphaMode::kBlend);
  EXPECT_EQ(paint.emissive, Vec3d(0, 0, 1));
  EXPECT_EQ(paint.roughness, 0.25);
  EXPECT_EQ(paint.metallic, 1);
  const TextureUse& use = paint.texture(TextureRole::kBaseColour);
  EXPECT_EQ(use.image, 0);
  EXPECT_EQ(use.wrap_u, Wrap::kClamp);
  // v = 0.25 up is 0.75 down: scaled and moved it is 3 * 0.25 + 0.25 = 1 up.
  EXPECT_EQ(place_in_texture(use, {0.25, 0.75}), Vec2d(1, 0));
  EXPECT_EQ(paint.texture(TextureRole::kNormal).image, 0) << "a path of another machine: what lies beside the file";
  EXPECT_EQ(asset.images.size(), 1U);
  const Material& dull = asset.material_looks[1];
  EXPECT_NEAR(dull.roughness, 0.5, 1e-9) << "2 / 0.5^4 - 2 is 30";
  EXPECT_EQ(dull.base_colour, Vec4d(1, 1, 1, 1)) << "a colour that is none";
  EXPECT_FALSE(dull.texture(TextureRole::kBaseColour).exists());
  EXPECT_EQ(asset.material_looks[2].metallic, 0);
  EXPECT_EQ(asset.deviations.notes("").size(), 2U) << "one picture is missing, one lies outside";
  ASSERT_EQ(asset.notes.size(), 1U) << "heights aren't read";
  EXPECT_NE(asset.notes[0].find("map_Bump"), std::string::npos) << asset.notes[0];
}

TEST_F(Obj, FacesBeforeTheFirstMaterialHaveNone) {
  const InputAsset asset = open("a.obj", kVertices + "f 1 2 3\nusemtl moss\nf 3 4 1\n");
  ASSERT_EQ(asset.meshes.at(0).primitives.size(), 2U);
  EXPECT_EQ(asset.read(0, 0).material, -1);
  EXPECT_EQ(asset.read(0, 1).material, 0);
}

TEST_F(Obj, TellsWhatItLeavesOut) {
  const InputAsset asset = open("a.obj", kVertices + "f 1 2 3 4\nl 1 2 3\np 1\ncurv 0 1 1 2\nteapot 7\n");
  expect_square(asset.read(0, 0));
  EXPECT_EQ(asset.ignored_primitives, 2);
  ASSERT_EQ(asset.notes.size(), 2U);
  EXPECT_NE(asset.notes[1].find("curv, teapot"), std::string::npos) << asset.notes[1];
}

TEST_F(Obj, IsRefusedWithTheLineWhereItIsBroken) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1\nf 1 2 3\n", "line 3: a coordinate is missing");
  expect_refused("a.obj", "v 0 0 0\nv 1 0 zero\nv 1 1\nf 1 2 3\n", "line 2: a coordinate is 'zero'");
  expect_refused("a.obj", "v 0 0 0\nv 1 inf 0\nf 1 2 3\n", "line 2: the position of vertex 2 is not finite");
  expect_refused("a.obj", three + "f 1 2 4\n", "line 4: a face names vertex 4, but there are 3, counted from 1");
  expect_refused("a.obj", three + "vt 0 0\nf 1/1 2/2 3/1\n",
                 "line 5: a face names texture coordinate 2, but there are 1");
  expect_refused("a.obj", three + "f 1//1 2//1 3//1\n", "line 4: a face names normal 1, but there are 0");
  expect_refused("a.obj", three + "f -1 -2 -4\n", "line 4: '-4' is no corner of a face: -4 counts back from 3");
  expect_refused("a.obj", three + "f 1/-1 2/-1 3/-1\n", "counts back from 0");
  expect_refused("a.obj", three + "f 0 1 2\n", "line 4: '0' is no corner");
  expect_refused("a.obj", three + "f 1 2 99999999999999999999\n", "no corner");
  expect_refused("a.obj", three + "f 1 2 9000000000000000000\n", "line 4: a face names vertex 9000000000000000000");
  expect_refused("a.obj", three + "f a b c\n", "'a' is no corner");
  expect_refused("a.obj", three + "f /1 /1 /1\n", "'/1' is no corner");
  expect_refused("a.obj", three, "no triangles");
  expect_refused("a.obj", "hello\n", "no triangles");
  expect_refused("a.obj", three + "f 1 2 " + std::string(100'000, '3') + "\n", "line 4: has a word of more than");
}

TEST_F(Obj, RefusesPolygonsThatNobodyDraws) {
  std::string polygon = "v 0 0 0\nf";
  for (int k = 0; k <= 1'000'000; ++k) polygon += " 1";
  expect_refused("a.obj", polygon, "line 2: a face has more than 1000000 corners");
}

TEST_F(Obj, TakesLinesOfAnyLength) {
  std::string polygon = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4";
  polygon += std::string(300'000, ' ') + "# " + std::string(300'000, 'x') + "\n";
  expect_square(read("a.obj", polygon));
}

TEST_F(Obj, ManyTextureCoordinatesAtOneVertexTakeNoAge) {
  std::string star = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 1; i <= 50'000; ++i) {
    star += "vt 0." + std::to_string(i) + " 0\nf 1/" + std::to_string(i) + " 2 3\n";
  }
  const Primitive mesh = read("a.obj", star);
  EXPECT_EQ(mesh.vertices(), 50'002U);
}

TEST_F(Obj, RefusesMaterialsWithoutEnd) {
  std::string many = kVertices;
  for (int m = 0; m <= 100'000; ++m) many += "usemtl " + std::to_string(m) + "\n";
  expect_refused("a.obj", many + "f 1 2 3\n", "names more than 100000 materials");
}

TEST_F(Obj, KeepsToTheLimits) {
  const std::string square = kVertices + "f 1 2 3 4\n";
  EXPECT_EQ(complaint("a.obj", square, ExitCode::kLimit, {.max_triangles = 2}), "");
  EXPECT_NE(complaint("a.obj", square, ExitCode::kLimit, {.max_triangles = 1}).find("--max-triangles"),
            std::string::npos);
  for (const std::string statement : {"v", "vt", "vn"}) {
    std::string large;
    for (int v = 0; v < 100'000; ++v) large += statement + " 0 0 " + std::to_string(v) + "\n";
    EXPECT_NE(complaint("a.obj", large + "f 1 2 3\n", ExitCode::kLimit, {.max_memory = 1'000'000}).find("reading it"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace lozenge
