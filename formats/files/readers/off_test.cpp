#include "formats/files/readers/off.h"

#include "formats/files/readers/reader_fixtures.h"

namespace lozenge {
namespace {

using namespace fixtures;

class Off : public ReaderTest {};

TEST_F(Off, MayHaveCommentsColoursNormalsAndPolygons) {
  expect_square(read("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n4 0 1 2 3\n"));
  expect_square(read("a.off", "OFF 4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 5e-1\r\n4 0 1 2 3\r\n"));
  expect_square(read("a.off", "OFF\r4 1 0\r0 0 0\r1 0 0\r1 1 0\r0 1 5e-1\r4 0 1 2 3\r"));
  expect_square(
      read("a.off",
           "# made by hand\nCOFF # colours\n4 2\n\n0 0 0 1 0 0 1 #red\n+1 0 0 0 0 0\n1 1 0\n\n0 1 .5 255 0 0 255\n"
           "3 0 1 2 1 0 0\n3 0 2 3 # the last"));
  expect_square(
      read("a.off", "\t NOFF\n4 2 5\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0.5 0 0 1\n3 0 1 2\n3 0 2 3"));
}

TEST_F(Off, GivesNormalsColoursAndTextureCoordinatesInTheOrderOfTheirPrefixes) {
  const Primitive mesh = read("a.off",
                              "STCNOFF\n3 1 0\n0 0 0  0 0 1  255 128 0 51  0 1\n1 0 0  0 1 0  0 0 0  1 .25\n"
                              "1 1 0  1 0 0  255 255 255 255  .5 0\n3 0 1 2\n");
  EXPECT_EQ(values_of(mesh, kNormals), (std::vector<float>{0, 0, 1, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(values_of(mesh, kTextureCoordinates), (std::vector<float>{0, 0, 1, 0.75F, 0.5F, 1})) << "v runs down";
  expect_near(values_of(mesh, kColors), {1, kHalfGray, 0, 0.2F, 0, 0, 0, 1, 1, 1, 1, 1});
}

TEST_F(Off, NeedsNoKeywordWhereItIsNamedSo) {
  const std::string content = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n4 0 1 2 3\n";
  expect_square(read("a.OFF", content));
  EXPECT_NE(complaint("a.txt", content).find("none of the formats"), std::string::npos);
}

TEST_F(Off, SkipsPointsAndLinesAmongItsFaces) {
  const InputAsset asset = open("a.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n1 3\n4 0 1 2 3\n2 0 1\n");
  expect_square(asset.read(0, 0));
  EXPECT_EQ(asset.ignored_primitives, 2);
  EXPECT_EQ(asset.notes.size(), 1U);
}

TEST_F(Off, IsRefusedWithTheLineWhereItIsBroken) {
  expect_refused("a.off", "", "is empty");
  expect_refused("a.off", "\n\n# nothing\n", "begin with OFF");
  expect_refused("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n 1 1 1", "line 5: the file ends where a coordinate");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 zero 0\n1 1 0\n3 0 1 2\n", "line 4: a coordinate is 'zero'");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 nan\n3 0 1 2\n",
                 "line 5: the position of vertex 2 is not finite");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 1e39\n3 0 1 2\n", "not finite");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 1e999\n3 0 1 2\n", "no number");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n",
                 "line 6: a face names vertex 3, but there are 3");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 -1\n", "names vertex -1");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 9000000000000000000\n", "names vertex 9");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n-3 0 1 2\n", "less than nothing");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1      ", "the file ends");
  expect_refused("a.off", "OFF\n-1 1 0\n0 0 0\n", "less than nothing");
  expect_refused("a.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n1 1 0\n", "3 vertices, but no triangles");
  expect_refused("a.off", "OFF\n0 0 0\n", "no triangles");
  expect_refused("a.off", "OFF\n" + std::string(5000, 'x'), "more than 1024 characters");
}

TEST_F(Off, IsRefusedBeforeMemoryIsTakenForWhatTheFileCannotHold) {
  expect_refused("a.off", "OFF\n9000000000000000000 1 0\n0 0 0\n",
                 "line 2: the number of vertices is 9000000000000000000");
  expect_refused("a.off", "OFF\n3 9000000000000000000 0\n0 0 0\n", "the number of faces is");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n2000000000 0 1 2\n", "line 6: the number of corners");
}

TEST_F(Off, SaysWhichKindsItDoesNotTake) {
  EXPECT_NE(complaint("a.off", "OFF BINARY\n\0\0\0\4", ExitCode::kUnsupported).find("ASCII"), std::string::npos);
  EXPECT_NE(complaint("a.off", "4OFF\n1 0 0\n0 0 0 1\n", ExitCode::kUnsupported).find("three"), std::string::npos);
}

TEST_F(Off, KeepsToTheLimits) {
  const std::string square = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 .5\n3 0 1 2\n3 0 2 3\n";
  EXPECT_EQ(complaint("a.off", square, ExitCode::kLimit, {.max_triangles = 2}), "");
  EXPECT_NE(complaint("a.off", square, ExitCode::kLimit, {.max_triangles = 1}).find("--max-triangles"),
            std::string::npos);
  EXPECT_NE(complaint("a.off", square, ExitCode::kLimit, {.max_memory = 500}).find("reading it"), std::string::npos);
}

}  // namespace
}  // namespace lozenge
