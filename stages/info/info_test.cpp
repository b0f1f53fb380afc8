#include "stages/info/info.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/source_mesh_file.h"
#include "formats/patches/image_fixtures.h"

namespace lozenge {
namespace {

class Info : public testing::Test {
 protected:
  fixtures::TestFolder folder_;

  nlohmann::json json_of(const char* name) const {
    const FileInfo info = describe_file(folder_ / name);
    EXPECT_GE(info.lines.size(), 3U);
    const auto json = nlohmann::json::parse(info.json);
    EXPECT_EQ(json["kind"], info.kind);
    return json;
  }
};

TEST_F(Info, CountsWhatAParameterizationHolds) {
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::icosahedron(), 5);
  write_parameterization(folder_ / "p.glb", mesh, map);
  const auto json = json_of("p.glb");
  EXPECT_EQ(json["kind"], "parameterization");
  EXPECT_EQ(json["mesh"]["triangles"], 500);
  EXPECT_EQ(json["mesh"]["euler"], 2);
  EXPECT_EQ(json["mesh"]["irregular_vertices"], 12);
  EXPECT_EQ(json["domain"]["triangles"], 20);
  EXPECT_EQ(json["domain"]["irregular_vertices"], 12);
  EXPECT_EQ(json["distortion"]["folded_triangles"], 0);
  EXPECT_GT(json["distortion"]["area"], 0);
}

TEST_F(Info, CountsWhatAMeshHolds) {
  write_source_mesh(folder_ / "m.glb", fixtures::subdivided_sphere(fixtures::octahedron(), 4).first);
  const auto json = json_of("m.glb");
  EXPECT_EQ(json["kind"], "source mesh");
  EXPECT_EQ(json["scene"], "sphere");
  EXPECT_EQ(json["mesh"]["triangles"], 128);
  EXPECT_EQ(json["mesh"]["closed_manifold"], true);
}

TEST_F(Info, CountsWhatPatchesAndImagesHold) {
  write_patch_set(folder_ / "s.exr", fixtures::sphere_patches(fixtures::octahedron(), 3));
  EXPECT_EQ(json_of("s.exr")["patches"]["count"], 12);
  write_geometry_image(folder_ / "g.exr", fixtures::sphere_image(fixtures::octahedron(), 3));
  for (const char* name : {"g.exr", "g.json"}) {
    const auto json = json_of(name);
    EXPECT_EQ(json["patches"]["samples"], 9);
    EXPECT_EQ(json["levels"].size(), 4U);
    EXPECT_EQ(json["levels"][0]["triangles"], 12 * 8 * 8 * 2);
    EXPECT_EQ(json["levels"][3]["triangles"], 12 * 2);
    EXPECT_EQ(json["mesh"]["irregular_vertices"], 6);
  }
}

TEST_F(Info, CountsWhatAMapHolds) {
  write_map(folder_ / "n.png", fixtures::flat_normal_map(), 8);
  const auto json = json_of("n.png");
  EXPECT_EQ(json["map"], "tangent-normal");
  EXPECT_EQ(json["width"], 24);
  EXPECT_EQ(json["layout"]["tile"], 8);
}

TEST_F(Info, CountsWhatSomebodyElsesGltfHolds) {
  std::ofstream(folder_ / "a.gltf") << R"({"asset": {"version": "2.0", "generator": "by hand"},
    "scenes": [{"name": "two", "nodes": [0, 1]}], "scene": 0, "nodes": [{"mesh": 0}, {"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}]})";
  const auto json = json_of("a.gltf");
  EXPECT_EQ(json["kind"], "glTF asset");
  EXPECT_EQ(json["scene"], "two");
  EXPECT_EQ(json["triangles"], 2);
  EXPECT_EQ(json["vertices"], 6);
}

TEST_F(Info, RefusesOtherFiles) {
  std::ofstream(folder_ / "x.txt") << "hello";
  EXPECT_THROW(describe_file(folder_ / "x.txt"), Error);
}

}  // namespace
}  // namespace lozenge
