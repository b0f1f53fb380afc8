// SourceMesh itself, and its file: what was written comes back bit by bit.
#include "formats/surface/source_mesh.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/attribute_fixtures.h"
#include "formats/surface/body_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

/// What a random mesh has.
struct Features {
  bool normals = false, loose_normals = false, uvs = false, colors = false, materials = false, sheets = false;
};
Features features_of(unsigned bits) {
  return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0, (bits & 32) != 0};
}

/// Vertices numbered by their first use; unused ones go.
void number_by_first_use(SourceMesh& mesh) {
  std::vector<VertexId> number(mesh.positions.size(), -1);
  std::vector<Vec3f> positions;
  for (auto& triangle : mesh.triangles) {
    for (VertexId& v : triangle) {
      if (number[v] < 0) {
        number[v] = static_cast<VertexId>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
  }
  mesh.positions = positions;
}

/// Triangles between random points, manifold or not, in canonical form. Attributes are drawn from few values, so that
/// some corners of a vertex share theirs and some don't.
SourceMesh random_mesh(std::mt19937& random, const Features& features) {
  std::uniform_real_distribution<float> number(-5, 5);
  std::uniform_real_distribution<float> share(0, 1);
  SourceMesh mesh;
  mesh.positions.resize(4 + random() % 60);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = {number(random), number(random), static_cast<float>(v)};  // distinct
    if (features.sheets && v > 0 && random() % 3 == 0) mesh.positions[v] = Vec3f(mesh.positions[random() % v]);
  }
  const auto vertices = static_cast<unsigned>(mesh.positions.size());
  const std::size_t triangles = 1 + random() % 100;
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto a = static_cast<VertexId>(random() % vertices);
    const auto b = static_cast<VertexId>((a + 1 + random() % (vertices - 1)) % vertices);
    VertexId c = a;
    while (c == a || c == b) c = static_cast<VertexId>(random() % vertices);
    mesh.triangles.push_back({a, b, c});
  }
  number_by_first_use(mesh);
  const auto add_few = [&](const AttributeKind& kind, auto make) {
    std::vector<decltype(make())> values;
    for (int i = 0; i < 5; ++i) values.push_back(make());
    for (std::size_t c = 0; c < 3 * triangles; ++c) fixtures::add_corner(mesh, kind, values[random() % values.size()]);
  };
  if (features.normals) {
    add_few(kNormals, [&] { return Vec3f(number(random), number(random), number(random)).normalized(); });
    if (features.loose_normals) fixtures::set_corner(mesh, kNormals, random() % (3 * triangles), Vec3f(0, 0, 0));
  }
  if (features.uvs) add_few(kTextureCoordinates, [&] { return Vec2f(number(random), number(random)); });
  if (features.colors) {
    add_few(kColors, [&] { return Vec4f(share(random), share(random), share(random), share(random)); });
  }
  if (features.materials) {
    for (unsigned m = 0; m < 1 + random() % 5; ++m)
      mesh.material_names.push_back(m == 1 ? "" : "m\xC3\xA4t " + std::to_string(m));
    for (std::size_t t = 0; t < triangles; ++t) {
      mesh.materials.push_back(static_cast<std::int32_t>(random() % mesh.material_names.size()));
    }
    std::sort(mesh.materials.begin(), mesh.materials.end());
    if (mesh.material_names.size() > 1 && random() % 2 == 0) {
      mesh.cap_of.assign(mesh.material_names.size(), -1);
      mesh.cap_of.back() = 0;
    }
    if (random() % 2 == 0) {
      mesh.double_sided.assign(mesh.material_names.size(), false);
      mesh.double_sided[random() % mesh.double_sided.size()] = true;
    }
    if (const auto kind = random() % 3; kind == 1) {
      mesh.bodies = fixtures::random_bodies(mesh.material_names.size(), random);
    } else if (kind == 2) {
      mesh.rig = fixtures::random_rig(random);
      mesh.bodies = fixtures::random_moving_bodies(mesh.material_names.size(), mesh.rig, random);
    }
  }
  if (mesh.bodies.has_skin()) {
    AttributeStream& influences = stream_for(mesh.corner_attributes, kInfluences);
    influences.values.assign(kInfluences.components * 3 * triangles, 0.0F);
    for (std::size_t c = 0; c < 3 * triangles; ++c) influences.at(c)[kMostJoints] = 1;
  }
  mesh.scene_name = random() % 2 == 0 ? "a \"scene\"" : "";
  mesh.origin = "st\xC3\xA4tue.glb";
  mesh.generator = random() % 2 == 0 ? "somebody's exporter 1.2" : "";
  return mesh;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void expect_same(const SourceMesh& a, const SourceMesh& b) {
  EXPECT_TRUE(same_bits(a.positions, b.positions));
  EXPECT_TRUE(same_bits(a.triangles, b.triangles));
  EXPECT_TRUE(fixtures::same_bits(a.corner_attributes, b.corner_attributes));
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.material_names, b.material_names);
  EXPECT_EQ(a.cap_of, b.cap_of);
  EXPECT_EQ(a.double_sided, b.double_sided);
  fixtures::expect_same(a.bodies, b.bodies);
  fixtures::expect_same(a.rig, b.rig);
  EXPECT_EQ(a.scene_name, b.scene_name);
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.generator, b.generator);
}

class SourceMeshFile : public testing::Test {
 protected:
  fixtures::TestFolder folder_;
};

TEST_F(SourceMeshFile, GivesBackTheSameBitsThatWereWritten) {
  std::mt19937 random(1);
  for (unsigned i = 0; i < 400; ++i) {
    SCOPED_TRACE(i);
    const SourceMesh mesh = random_mesh(random, features_of(i % 64));
    write_source_mesh(folder_ / "mesh.glb", mesh);
    expect_same(mesh, read_source_mesh(folder_ / "mesh.glb"));
  }
}

TEST_F(SourceMeshFile, HoldsTheSameBytesWhereverAndWheneverItIsWritten) {
  std::mt19937 random(2);
  for (unsigned i = 0; i < 64; ++i) {
    const SourceMesh mesh = random_mesh(random, features_of(i));
    write_source_mesh(folder_ / "first.glb", mesh);
    write_source_mesh(folder_ / "second.glb", read_source_mesh(folder_ / "first.glb"));
    EXPECT_EQ(fixtures::bytes_of(folder_ / "first.glb"), fixtures::bytes_of(folder_ / "second.glb"));
  }
}

TEST_F(SourceMeshFile, SplitsVerticesOnlyAsFarAsAttributesDiffer) {
  SourceMesh mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), 16).first;
  const auto size_with_uvs = [&](auto uv_of) {
    mesh.corner_attributes.clear();
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c)
      fixtures::add_corner(mesh, kTextureCoordinates, uv_of(c));
    write_source_mesh(folder_ / "mesh.glb", mesh);
    return fs::file_size(folder_ / "mesh.glb");
  };
  const auto vertex = [&](std::size_t c) { return mesh.triangles[c / 3][c % 3]; };
  const auto smooth = size_with_uvs([&](std::size_t c) { return Vec2f(static_cast<float>(vertex(c)), 0); });
  const auto split = size_with_uvs([&](std::size_t c) { return Vec2f(static_cast<float>(c), 0); });
  // Position and UV take 20 bytes a vertex; the rest is the same but for some digits of JSON.
  const auto corners = 3 * mesh.triangles.size();
  EXPECT_NEAR(static_cast<double>(split - smooth), static_cast<double>(20 * (corners - mesh.positions.size())), 64);
}

TEST_F(SourceMeshFile, TakesTheRepeatedMeshesOfOlderFilesForBodies) {
  using tinygltf::Value;
  std::mt19937 random(6);
  SourceMesh mesh = random_mesh(random, features_of(31));
  mesh.material_names = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.cap_of.clear();
  mesh.double_sided.clear();
  mesh.rig = {};
  mesh.bodies = {{{"ball", {{}, {fixtures::random_placement(random), -1}}, -1}}, {0}};
  write_source_mesh(folder_ / "new.glb", mesh);
  const GltfFile file = open_gltf(folder_ / "new.glb");
  Value::Object& stored = file.model->asset.extras.Get<Value::Object>()["lozenge"].Get<Value::Object>();
  Value::Array copy;
  for (const double x : mesh.bodies.bodies[0].places[1].placement) copy.emplace_back(x);
  stored.erase("bodies");
  stored.erase("body_of");
  const Value copies(Value::Array{Value(std::move(copy))});
  stored["repeated"] =
      Value(Value::Array{Value(Value::Object{{"name", Value(std::string("ball"))}, {"copies", copies}})});
  stored["repeated_of"] = Value(Value::Array{Value(0)});
  write_glb(folder_ / "old.glb", *file.model);
  fixtures::expect_same(read_source_mesh(folder_ / "old.glb").bodies, mesh.bodies);
}

TEST_F(SourceMeshFile, HasNoBodiesWhereTheirPlacesAreNoNodes) {
  std::mt19937 random(3);
  SourceMesh mesh = random_mesh(random, features_of(0));
  mesh.material_names = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.rig = fixtures::random_rig(random);
  for (const std::int32_t node : {-2, 1000, std::numeric_limits<std::int32_t>::max()}) {
    mesh.bodies = {{{"face", {{kUnmoved, node}}, -1, {{"grin", 0.5}}}}, {0}};
    write_source_mesh(folder_ / "mesh.glb", mesh);
    EXPECT_TRUE(read_source_mesh(folder_ / "mesh.glb").bodies.empty()) << node;
  }
}

TEST_F(SourceMeshFile, RefusesASkinWhoseVerticesHaveNoJoints) {
  std::mt19937 random(3);
  SourceMesh mesh = random_mesh(random, features_of(31));
  mesh.material_names = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.cap_of.clear();
  mesh.double_sided.clear();
  mesh.rig = fixtures::random_rig(random);
  mesh.bodies = {{{"skin", {{}}, 0}}, {0}};
  std::erase_if(mesh.corner_attributes, [](const AttributeStream& stream) { return stream.kind == kInfluences; });
  write_source_mesh(folder_ / "mesh.glb", mesh);
  try {
    read_source_mesh(folder_ / "mesh.glb");
    ADD_FAILURE() << "was not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUnusableInput);
    EXPECT_NE(std::string(error.what()).find("have no joints"), std::string::npos) << error.what();
  }
}

TEST_F(SourceMeshFile, RefusesOtherFilesAndChangedOnes) {
  std::mt19937 random(3);
  const SourceMesh mesh = random_mesh(random, features_of(31));
  write_source_mesh(folder_ / "mesh.glb", mesh);
  const std::string good = fixtures::bytes_of(folder_ / "mesh.glb");
  const auto expect_refused = [&](const std::string& from, const std::string& to, ExitCode code) {
    ASSERT_EQ(from.size(), to.size());
    std::string bad = good;
    const std::size_t at = bad.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    bad.replace(at, from.size(), to);
    std::ofstream(folder_ / "bad.glb", std::ios::binary) << bad;
    try {
      read_source_mesh(folder_ / "bad.glb");
      ADD_FAILURE() << "was not refused: " << to;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_EQ(std::string(error.what()).find("bad.glb: "), 0U) << error.what();
    }
  };
  expect_refused("\"source mesh\"", "\"savory mesh\"", ExitCode::kUnusableInput);
  expect_refused("\"lozenge\":{", "\"rhombus\":{", ExitCode::kUnusableInput);
  expect_refused("\"version\":1,", "\"version\":7,", ExitCode::kUnsupported);
  expect_refused("\"triangles\":", "\"triangels\":", ExitCode::kUnusableInput);
  expect_refused("\"origin\":", "\"orange\":", ExitCode::kUnusableInput);
  std::ofstream(folder_ / "cut.glb", std::ios::binary) << good.substr(0, good.size() - 4);
  EXPECT_THROW(read_source_mesh(folder_ / "cut.glb"), Error);
}

TEST_F(SourceMeshFile, LeavesNothingWhereItCannotBeWritten) {
  std::mt19937 random(4);
  const SourceMesh mesh = random_mesh(random, features_of(0));
  EXPECT_THROW(write_source_mesh(folder_ / "missing/mesh.glb", mesh), Error);
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST(SourceMesh, HasBoundsThatHoldEveryPositionAndTouchOnAllSides) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const SourceMesh mesh = random_mesh(random, {});
    const Bounds box = bounds_of(mesh.positions);
    for (int axis = 0; axis < 3; ++axis) {
      float low = INFINITY;
      float high = -INFINITY;
      for (const Vec3f& p : mesh.positions) {
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
      }
      EXPECT_EQ(box.low[axis], low);
      EXPECT_EQ(box.high[axis], high);
    }
    EXPECT_NEAR(diagonal(box), Vec3d(box.high - box.low).length(), 1e-5);
  }
  EXPECT_EQ(diagonal(bounds_of({})), 0);
}

TEST(SourceMesh, HasVertexNormalsThatPointAwayFromASpheresCentre) {
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    const SourceMesh mesh = fixtures::subdivided_sphere(base, 24).first;
    const std::vector<Vec3f> normals = vertex_normals(mesh);
    ASSERT_EQ(normals.size(), mesh.positions.size());
    for (std::size_t v = 0; v < normals.size(); ++v) {
      EXPECT_NEAR(normals[v].length(), 1, 1e-6);
      EXPECT_GT(normals[v].dot(mesh.positions[v]), 0.97);
    }
  }
}

TEST(ShadingNormals, TakesTheAssetsOwnAndElseSmoothOnes) {
  SourceMesh mesh = fixtures::subdivided_sphere(fixtures::octahedron(), 8).first;
  const std::vector<Vec3f> smooth = vertex_normals(mesh);
  const ShadingNormals without(mesh);
  for (TriangleId t = 0; t < static_cast<TriangleId>(mesh.triangles.size()); ++t) {
    EXPECT_LT((without.at(t, {0, 1, 0}) - smooth[mesh.triangles[t][1]]).length(), 1e-6);
  }
  SourceMesh own = mesh;
  for (std::size_t c = 0; c < 3 * own.triangles.size(); ++c) fixtures::add_corner(own, kNormals, Vec3f(0, 1, 0));
  fixtures::set_corner(own, kNormals, 5, Vec3f(0, -1, 0));
  const ShadingNormals with(own);
  EXPECT_EQ(with.at(0, {0.2, 0.3, 0.5}), Vec3f(0, 1, 0));
  EXPECT_EQ(with.at(1, {0, 0, 1}), Vec3f(0, -1, 0));
  // Half way between opposite normals there is none: the triangle's own stands in.
  const auto& [a, b, c] = own.triangles[1];
  const Vec3f face = (own.positions[b] - own.positions[a]).cross(own.positions[c] - own.positions[a]).normalized();
  EXPECT_LT((with.at(1, {0.5, 0, 0.5}) - face).length(), 1e-5);
}

}  // namespace
}  // namespace lozenge
