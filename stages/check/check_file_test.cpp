#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/source_mesh_file.h"
#include "formats/patches/image_fixtures.h"
#include "stages/check/check.h"
#include "stages/check/check_source_mesh.h"

namespace lozenge {
namespace {

class CheckFile : public testing::Test {
 protected:
  fixtures::TestFolder folder_;

  static std::string text(const CheckReport& report) {
    std::string all = report.kind + "\n";
    for (const std::string& line : report_lines(report)) all += line + "\n";
    return all;
  }
};

TEST_F(CheckFile, PassesForEverySoundFile) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 4);
  fixtures::jitter(map, 0.05, 3);
  write_source_mesh(folder_ / "mesh.glb", mesh);
  write_parameterization(folder_ / "map.glb", mesh, map);
  write_patch_set(folder_ / "patches.exr", fixtures::sphere_patches(fixtures::icosahedron(), 3));
  write_geometry_image(folder_ / "image.exr", fixtures::sphere_image(fixtures::icosahedron(), 3));
  write_map(folder_ / "n8.png", fixtures::flat_normal_map(), 8);
  write_map(folder_ / "n16.png", fixtures::flat_normal_map(), 16);
  write_map(folder_ / "n.exr", fixtures::flat_normal_map(), 16);
  for (const char* name :
       {"mesh.glb", "map.glb", "patches.exr", "image.exr", "image.json", "n8.png", "n16.png", "n.exr"}) {
    const CheckReport report = check_file(folder_ / name);
    EXPECT_TRUE(report.passed()) << text(report);
    EXPECT_EQ(report.code, ExitCode::kDone);
    EXPECT_GE(report.lines.size(), 4U) << text(report);
  }
}

TEST_F(CheckFile, FindsAFoldInAFile) {
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 6);
  for (DomainPoint& p : map.phi) {
    if (p.alpha > 0.3 && p.beta > 0.3 && p.gamma() > 0.3) {
      p = make_point(p.triangle, p.alpha + 0.3, p.beta - 0.25);
      break;
    }
  }
  write_parameterization(folder_ / "map.glb", mesh, map);
  const CheckReport report = check_file(folder_ / "map.glb");
  ASSERT_NE(report.find("no folded triangle"), nullptr);
  EXPECT_FALSE(report.find("no folded triangle")->passed);
  EXPECT_EQ(report.code, ExitCode::kUnusableInput);
}

TEST_F(CheckFile, FindsATurnedTriangleInASourceMeshAndTellsHowOpenItIs) {
  SourceMesh mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), 2).first;
  mesh.triangles.pop_back();
  CheckReport report = check_source_mesh(mesh);
  ASSERT_NE(report.find("oriented 2-manifold"), nullptr);
  EXPECT_TRUE(report.find("oriented 2-manifold")->passed);
  EXPECT_NE(report.find("oriented 2-manifold")->detail.find("1 boundary loop(s) of 3 edges"), std::string::npos);
  std::swap(mesh.triangles[20][0], mesh.triangles[20][1]);
  report = check_source_mesh(mesh);
  EXPECT_FALSE(report.find("oriented 2-manifold")->passed);
}

TEST_F(CheckFile, FindsASourceMeshWhoseTrianglesTouchInAVertexAlone) {
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const CheckReport report = check_source_mesh(mesh);
  ASSERT_NE(report.find("oriented 2-manifold"), nullptr);
  EXPECT_FALSE(report.find("oriented 2-manifold")->passed);
}

TEST_F(CheckFile, FindsAJsonThatSaysSomethingElseOrIsMissing) {
  const auto exr = folder_ / "image.gim.exr";
  write_geometry_image(exr, fixtures::sphere_image(fixtures::octahedron(), 2));
  const std::string name = "the JSON beside it says the same";
  std::string json = fixtures::bytes_of(json_beside(exr));
  const std::size_t at = json.find("\"samples\": 5");
  ASSERT_NE(at, std::string::npos);
  json.replace(at, 12, "\"samples\": 9");
  std::ofstream(json_beside(exr), std::ios::binary) << json;
  const CheckReport changed = check_file(exr);
  ASSERT_NE(changed.find(name), nullptr);
  EXPECT_FALSE(changed.find(name)->passed);
  EXPECT_NE(changed.find(name)->detail.find("samples"), std::string::npos);
  std::filesystem::remove(json_beside(exr));
  EXPECT_FALSE(check_file(exr).find(name)->passed);
}

TEST_F(CheckFile, WhatTheReaderRefusesIsALineWithItsCode) {
  write_geometry_image(folder_ / "image.exr", fixtures::sphere_image(fixtures::octahedron(), 3));
  const std::string whole = fixtures::bytes_of(folder_ / "image.exr");
  std::ofstream(folder_ / "image.exr", std::ios::binary) << whole.substr(0, whole.size() - 400);
  const CheckReport report = check_file(folder_ / "image.exr");
  ASSERT_NE(report.find("readable"), nullptr);
  EXPECT_FALSE(report.find("readable")->passed);
  EXPECT_EQ(report.code, ExitCode::kUnusableInput);
  EXPECT_NE(report.find("readable")->detail.find("image.exr"), std::string::npos);
}

TEST_F(CheckFile, WhatIsNoFileOfOursIsAnError) {
  EXPECT_THROW(check_file(folder_ / "missing.glb"), Error);
  std::ofstream(folder_ / "notes.txt") << "hello";
  EXPECT_THROW(check_file(folder_ / "notes.txt"), Error);
}

}  // namespace
}  // namespace lozenge
