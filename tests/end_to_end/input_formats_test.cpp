// One mesh in every format that is read: they give the same asset, all commands take them, and broken ones are refused
// with their place.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "stages/import/gltf_fixtures.h"
#include "stages/import/import.h"
#include "tests/end_to_end/run_program.h"

namespace lozenge::end_to_end {
namespace {

using nlohmann::json;

const std::vector<std::string> kFormats{"glb", "ply", "obj", "stl", "off"};

std::string glb_of(const SourceMesh& mesh) {
  testing_gltf::TestGltf gltf;
  gltf.document["asset"].erase("generator");  // the others say nothing of theirs
  std::vector<std::uint32_t> indices;
  for (const auto& triangle : mesh.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  gltf.add_simple_mesh(mesh.positions, indices);
  return gltf.glb();
}

/// Binary, little-endian.
std::string ply_of(const SourceMesh& mesh) {
  std::string ply = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangles.size());
  for (const Vec3f& p : mesh.positions) ply.append(reinterpret_cast<const char*>(&p), sizeof(p));
  for (const auto& triangle : mesh.triangles) {
    ply += '\3';
    ply.append(reinterpret_cast<const char*>(triangle.data()), sizeof(triangle));
  }
  return ply;
}

// fmt writes the shortest text that gives the same float again.

std::string obj_of(const SourceMesh& mesh) {
  std::string obj = "# a test\n";
  for (const Vec3f& p : mesh.positions) obj += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) obj += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return obj;
}

std::string stl_of(const SourceMesh& mesh) {
  std::string stl = "solid\n";
  for (const auto& triangle : mesh.triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const VertexId v : triangle) {
      const Vec3f& p = mesh.positions[v];
      stl += fmt::format("vertex {} {} {}\n", p.x, p.y, p.z);
    }
    stl += "endloop\nendfacet\n";
  }
  return stl + "endsolid\n";
}

std::string off_of(const SourceMesh& mesh) {
  std::string off = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const Vec3f& p : mesh.positions) off += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) off += fmt::format("3 {} {} {}\n", a, b, c);
  return off;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

class InputFormats : public InOwnFolder<> {
 protected:
  /// A test asset's shape as statue.ENDING, for every format.
  void write_statues(const char* asset) {
    const SourceMesh mesh = import_asset(test_asset(asset));
    write_text(path("statue.glb"), glb_of(mesh));
    write_text(path("statue.ply"), ply_of(mesh));
    write_text(path("statue.obj"), obj_of(mesh));
    write_text(path("statue.stl"), stl_of(mesh));
    write_text(path("statue.off"), off_of(mesh));
  }

  json result_of(std::vector<std::string> arguments) const {
    arguments.emplace_back("--json");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments[0] << ": " << outcome.err;
    return outcome.code == 0 ? json::parse(outcome.out) : json();
  }
};

TEST_F(InputFormats, GiveTheSameAssetOfTheSameMesh) {
  write_statues("two_components.glb");
  std::map<std::string, std::string> expected;
  for (const std::string& format : kFormats) {
    const std::string folder = path("of_" + format);
    const Outcome built = run({"build", path("statue." + format), "-o", folder, "--no-preview", "--domain-faces",
                               "60..120", "--map-size", "512", "--occlusion-size", "128", "--occlusion-rays", "16"});
    ASSERT_EQ(built.code, 0) << built.err;
    std::map<std::string, std::string> files = content_of(folder);
    EXPECT_EQ(files.size(), 5U) << "asset, geometry image and its description, two maps";
    // Files say what they come from; that name is as long for all, and all else is the same.
    for (auto& [name, bytes] : files) bytes = replaced(bytes, "statue." + format, "statue.glb");
    if (expected.empty()) expected = files;
    for (const auto& [name, bytes] : files) EXPECT_TRUE(bytes == expected[name]) << format << ": " << name;
  }
}

TEST_F(InputFormats, AreTakenByTheCommandsThatLookAtSurfaces) {
  write_statues("cube.glb");
  for (const std::string& format : kFormats) {
    const std::string file = path("statue." + format);
    EXPECT_EQ(result_of({"compare", file, path("statue.glb"), "--points", "100"})["max_percent"], 0) << format;
    for (const char* style : {"shaded", "wires"}) {
      result_of({"render", file, "-o", path("picture.png"), "--style", style, "--width", "64", "--height", "64"});
    }
    if (format != "glb") {
      EXPECT_GT(result_of({"info", file})["triangles"], 0) << format;
    }
  }
}

TEST_F(InputFormats, BringColoursTextureCoordinatesNormalsAndMaterialsAlong) {
  write_text(path("a.obj"),
             "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 1\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n"
             "usemtl stone\nf 1/1/1 3/3/1 2/2/1\nf 1/1/1 2/2/1 4/3/1\nusemtl moss\nf 2/1/1 3/2/1 4/3/1\nf 3/1/1 1/2/1 "
             "4/3/1\n");
  result_of({"import", path("a.obj"), "-o", path("mesh.glb"), "--strict"});
  const json mesh = result_of({"info", path("mesh.glb")});
  EXPECT_EQ(mesh["attributes"], json({"normals", "texture coordinates", "colours"}));
  EXPECT_EQ(mesh["materials"], json({"stone", "moss"}));
  EXPECT_EQ(mesh["origin"], "a.obj");
}

TEST_F(InputFormats, ThatAreBrokenAreRefusedWithTheirPlace) {
  const std::map<std::string, std::pair<std::string, std::string>> broken{
      {"a.ply", {"ply\nformat ascii 1.0\nelement vertex many\n", "line 3"}},
      {"b.ply",
       {"ply\nformat binary_little_endian 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty "
        "float z\nend_header\n123",
        "line 7"}},
      {"a.obj", {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n", "line 4"}},
      {"a.stl", {"solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", "line 4"}},
      {"b.stl", {std::string(84, '\1'), "byte 80"}},
      {"a.off", {"OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 4"}},
      {"a.txt", {"hello", "none of the formats"}},
  };
  for (const auto& [name, content] : broken) {
    write_text(path(name), content.first);
    for (const std::string command : {"import", "build"}) {
      const Outcome refused = run({command, path(name), "-o", path("out"), "-q"});
      EXPECT_EQ(refused.code, 3) << refused.err;
      EXPECT_NE(refused.err.find(name + ": "), std::string::npos) << refused.err;
      EXPECT_NE(refused.err.find(content.second), std::string::npos) << refused.err;
      EXPECT_FALSE(std::filesystem::exists(path("out")));
    }
  }
}

}  // namespace
}  // namespace lozenge::end_to_end
