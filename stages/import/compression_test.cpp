// Meshes compressed by meshoptimizer and by Draco: they are read as if they were not, and hostile ones do no harm.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "formats/base/error.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/attribute_fixtures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import.h"
#include "stages/import/surface.h"
// After test_gltf.h, which it builds on.
#include "stages/import/compression_fixtures.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

SourceMesh import_glb(const TestFolder& folder, TestGltf gltf) {
  write_bytes(folder / "asset.glb", gltf.glb());
  return import_asset(folder / "asset.glb");
}

void expect_refused(const TestFolder& folder, TestGltf gltf, ExitCode code, const std::vector<std::string>& texts,
                    const ImportOptions& options = {}) {
  write_bytes(folder / "bad.glb", gltf.glb());
  try {
    import_asset(folder / "bad.glb", options);
    ADD_FAILURE() << "was not refused; expected a message about " << texts.front();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find("bad.glb"), 0U) << message;
    for (const std::string& text : texts)
      EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks " << text;
  }
}

/// Random damage to the compressed bytes gives a mesh or one of our errors.
void expect_damage_is_harmless(const TestFolder& folder, const TestGltf& good, unsigned seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < 500; ++i) {
    TestGltf bad = good;
    const unsigned changes = 1 + random() % 4;
    for (unsigned k = 0; k < changes; ++k) bad.bytes[random() % bad.bytes.size()] = static_cast<char>(random() % 256);
    write_bytes(folder / "damaged.glb", bad.glb());
    try {
      import_asset(folder / "damaged.glb", {.max_triangles = 100'000});
    } catch (const Error& error) {
      EXPECT_NE(error.code(), ExitCode::kInternal) << error.what();
    }
  }
}

struct Sphere {
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> indices;
};

Sphere sphere() {
  const SourceMesh mesh = fixtures::subdivided_sphere(fixtures::icosahedron(), 4).first;
  Sphere made{mesh.positions, {}};
  for (const auto& triangle : mesh.triangles) {
    for (const VertexId v : triangle) made.indices.push_back(static_cast<std::uint32_t>(v));
  }
  return made;
}

// ---- meshoptimizer
// ---------------------------------------------------------------------------------------------------

TEST(MeshoptCompression, GivesTheMeshThatWasCompressedInEachModeAndIndexSize) {
  const TestFolder folder;
  const Sphere ball = sphere();
  for (const std::string mode : {"TRIANGLES", "INDICES"}) {
    for (const int size : {2, 4}) {
      SCOPED_TRACE(mode + " of " + std::to_string(size) + " bytes");
      TestGltf plain;
      const int p = plain.add_values(TestGltf::flat(ball.positions), "VEC3", kFloat);
      const std::vector<std::uint16_t> small(ball.indices.begin(), ball.indices.end());
      const int i = size == 2 ? plain.add_values(small, "SCALAR", kUnsignedShort)
                              : plain.add_values(ball.indices, "SCALAR", kUnsignedInt);
      plain.add_node({{"mesh", plain.add_mesh({{{"attributes", {{"POSITION", p}}}, {"indices", i}}})}});
      const TestGltf packed = meshopt_compressed(plain, {{"ATTRIBUTES", 12, ""}, {mode, size, ""}});
      const SourceMesh mesh = import_glb(folder, packed);
      const SourceMesh expected = import_glb(folder, plain);
      if (mode == "INDICES") expect_same_mesh(mesh, expected);
      // A triangle's first corner may be another one, which renumbers the vertices.
      EXPECT_EQ(mesh.positions.size(), expected.positions.size());
      EXPECT_EQ(mesh.triangles.size(), expected.triangles.size());
      EXPECT_NEAR(enclosed_volume(mesh), enclosed_volume(expected), 1e-5);
      EXPECT_EQ(require_manifold(mesh, "sphere").euler, 2);
    }
  }
}

TEST(MeshoptCompression, UndoesTheFiltersOfPositionsAndNormals) {
  const TestFolder folder;
  const Sphere ball = sphere();
  const std::size_t count = ball.positions.size();
  std::vector<float> with_w;
  for (const Vec3f& p : ball.positions) with_w.insert(with_w.end(), {p.x, p.y, p.z, 0});
  std::vector<std::uint32_t> positions(3 * count);
  meshopt_encodeFilterExp(positions.data(), count, 12, 23, TestGltf::flat(ball.positions).data());
  for (const bool wide : {false, true}) {
    std::vector<std::uint8_t> normals((wide ? 8 : 4) * count);
    meshopt_encodeFilterOct(normals.data(), count, wide ? 8 : 4, wide ? 16 : 8, with_w.data());
    TestGltf plain;
    const int position_view = plain.add_view(positions);
    const int normal_view = plain.add_view(normals, wide ? 8 : 4);
    const int p = plain.add_accessor(
        {{"bufferView", position_view}, {"componentType", kFloat}, {"type", "VEC3"}, {"count", count}});
    const int n = plain.add_accessor({{"bufferView", normal_view},
                                      {"componentType", wide ? kShort : kByte},
                                      {"normalized", true},
                                      {"type", "VEC3"},
                                      {"count", count}});
    const int i = plain.add_values(ball.indices, "SCALAR", kUnsignedInt);
    plain.add_node({{"mesh", plain.add_mesh({{{"attributes", {{"POSITION", p}, {"NORMAL", n}}}, {"indices", i}}})}});
    const SourceMesh mesh = import_glb(folder, meshopt_compressed(plain, {{"ATTRIBUTES", 12, "EXPONENTIAL"},
                                                                          {"ATTRIBUTES", wide ? 8 : 4, "OCTAHEDRAL"}}));
    ASSERT_EQ(mesh.triangles.size(), ball.indices.size() / 3);
    for (std::size_t c = 0; c < ball.indices.size(); ++c) {
      const Vec3f& expected = ball.positions[ball.indices[c]];
      const Vec3f& found = mesh.positions[static_cast<std::size_t>(mesh.triangles[c / 3][c % 3])];
      // Mantissas have 23 bits for all three components together.
      EXPECT_LT((found - expected).length(), 1e-6F);
      // Steps of an octahedron of 2^8 or 2^16 are below 2/127 and 2/32767 on a side.
      EXPECT_LT((fixtures::corner_normals(mesh)[c] - expected).length(), wide ? 1e-4F : 0.025F);
    }
  }
}

TEST(MeshoptCompression, UndoesTheFilterOfRotationsThatInstancesAreTurnedBy) {
  const TestFolder folder;
  // A quarter around z, and none.
  const float h = std::sqrt(0.5F);
  const std::vector<float> rotations{0, 0, h, h, 0, 0, 0, 1};
  std::vector<std::int16_t> encoded(8);
  meshopt_encodeFilterQuat(encoded.data(), 2, 8, 16, rotations.data());
  TestGltf plain;
  const int view = plain.add_view(encoded, 8);
  const int rotation = plain.add_accessor(
      {{"bufferView", view}, {"componentType", kShort}, {"normalized", true}, {"type", "VEC4"}, {"count", 2}});
  plain.add_simple_mesh(tetrahedron_positions(), tetrahedron_indices());
  plain.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = rotation;
  TestGltf compressed = meshopt_compressed(plain, {{"ATTRIBUTES", 8, "QUATERNION"}});
  write_bytes(folder / "asset.glb", compressed.glb());
  const SourceMesh mesh = import_asset(folder / "asset.glb", {.instances = Instances::kSeparate});
  ASSERT_EQ(mesh.triangles.size(), 8U);
  EXPECT_LT((mesh.positions[0] - Vec3f(-1, 1, 1)).length(), 1e-3F) << "(1, 1, 1) after a quarter turn";
}

TestGltf compressed_tetrahedron() {
  return meshopt_compressed(tetrahedron(), {{"ATTRIBUTES", 12, ""}, {"TRIANGLES", 4, ""}});
}

TEST(MeshoptCompression, NeverOpensTheBufferThatOnlyStandsIn) {
  const TestFolder folder;
  TestGltf gltf = compressed_tetrahedron();
  gltf.document["buffers"][1]["uri"] = "not there.bin";
  EXPECT_EQ(import_glb(folder, gltf).triangles.size(), 4U);
}

TEST(MeshoptCompression, WhatContradictsItselfIsRefusedAndNamed) {
  const TestFolder folder;
  struct Case {
    std::vector<std::string> texts;
    std::function<void(json& views, json& positions, json& indices)> damage;
  };
  const std::vector<Case> cases{
      {{"buffer view 0", "mode \"LINES\""}, [](json&, json& p, json&) { p["mode"] = "LINES"; }},
      {{"buffer view 0", "filter \"X\""}, [](json&, json& p, json&) { p["filter"] = "X"; }},
      {{"buffer view 0", "byteStride of 12"}, [](json&, json& p, json&) { p["filter"] = "OCTAHEDRAL"; }},
      {{"buffer view 0", "byteStride of 12"}, [](json&, json& p, json&) { p["filter"] = "QUATERNION"; }},
      {{"buffer view 0", "byteStride of 0"}, [](json&, json& p, json&) { p["byteStride"] = 0; }},
      {{"buffer view 0", "byteStride is 1000"}, [](json&, json& p, json&) { p["byteStride"] = 1000; }},
      {{"buffer view 1", "byteStride of 3"}, [](json&, json&, json& i) { i["byteStride"] = 3; }},
      {{"buffer view 1", "only ATTRIBUTES"}, [](json&, json&, json& i) { i["filter"] = "EXPONENTIAL"; }},
      {{"buffer view 1", "multiple of 3"}, [](json&, json&, json& i) { i["count"] = 11; }},
      {{"buffer view 0", "byteLength is 48", "5 elements of 12"}, [](json&, json& p, json&) { p["count"] = 5; }},
      {{"buffer view 0", "byteLength is 48", "0 elements"}, [](json&, json& p, json&) { p["count"] = 0; }},
      {{"buffer view 0", "count"}, [](json&, json& p, json&) { p["count"] = 18446744073709551615ULL; }},
      {{"buffer view 0", "can't hold a count of 1000000"},
       [](json& views, json& p, json&) {
         p["count"] = 1'000'000;
         views[0]["byteLength"] = 12'000'000;
       }},
      {{"buffer view 1", "can't hold a count of 3000000"},
       [](json& views, json&, json& i) {
         i["count"] = 3'000'000;
         views[1]["byteLength"] = 12'000'000;
       }},
      {{"buffer view 0", "past buffer 0"}, [](json&, json& p, json&) { p["byteOffset"] = 1'000'000; }},
      {{"buffer view 0", "buffer is 2"}, [](json&, json& p, json&) { p["buffer"] = 2; }},
      {{"buffer view 0", "past buffer 1, which has 0"}, [](json&, json& p, json&) { p["buffer"] = 1; }},
      {{"buffer view 0", "damaged"}, [](json&, json& p, json&) { p["byteOffset"] = 4; }},
      {{"buffer view 0", "byteStride is 16"}, [](json& views, json&, json&) { views[0]["byteStride"] = 16; }},
      {{"buffer view 0", "past buffer 1, which has 0"},
       [](json& views, json&, json&) { views[0].erase("extensions"); }},
      {{"buffer view 0", "extensions"}, [](json& views, json&, json&) { views[0]["extensions"] = 1; }},
      {{"buffer view 0", "not a JSON object"},
       [](json& views, json&, json&) { views[0]["extensions"]["EXT_meshopt_compression"] = 1; }},
  };
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.texts.back());
    TestGltf gltf = compressed_tetrahedron();
    json& views = gltf.document["bufferViews"];
    bad.damage(views, views[0]["extensions"]["EXT_meshopt_compression"],
               views[1]["extensions"]["EXT_meshopt_compression"]);
    expect_refused(folder, gltf, ExitCode::kUnusableInput, bad.texts);
  }
}

TEST(MeshoptCompression, DamagedBytesAreHarmless) {
  const TestFolder folder;
  TestGltf plain;
  const Sphere ball = sphere();
  plain.add_simple_mesh(ball.positions, ball.indices);
  expect_damage_is_harmless(folder, meshopt_compressed(plain, {{"ATTRIBUTES", 12, ""}, {"TRIANGLES", 4, ""}}), 1);
  expect_damage_is_harmless(folder, meshopt_compressed(plain, {{"ATTRIBUTES", 12, "EXPONENTIAL"}, {"INDICES", 4, ""}}),
                            2);
}

// ---- Draco
// -----------------------------------------------------------------------------------------------------------

std::vector<Vec2f> uvs_of(const std::vector<Vec3f>& positions) {
  std::vector<Vec2f> uvs;
  for (const Vec3f& p : positions) uvs.emplace_back(p.x + p.z, p.y - p.z);
  return uvs;
}

TEST(DracoCompression, GivesTheSameMeshWhereItsOrderIsKept) {
  const TestFolder folder;
  const Sphere ball = sphere();
  const SourceMesh mesh = import_glb(
      folder, draco_compressed(ball.positions, uvs_of(ball.positions), ball.indices, draco::MESH_SEQUENTIAL_ENCODING));
  TestGltf plain;
  plain.add_simple_mesh(ball.positions, ball.indices);
  plain.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = [&] {
    std::vector<float> flat;
    for (const Vec2f& uv : uvs_of(ball.positions)) flat.insert(flat.end(), {uv.x, uv.y});
    return plain.add_values(flat, "VEC2", kFloat);
  }();
  expect_same_mesh(mesh, import_glb(folder, plain));
}

TEST(DracoCompression, GivesTheSameSurfaceAndAttributesInWhateverOrder) {
  const TestFolder folder;
  const Sphere ball = sphere();
  const SourceMesh mesh = import_glb(
      folder, draco_compressed(ball.positions, uvs_of(ball.positions), ball.indices, draco::MESH_EDGEBREAKER_ENCODING));
  EXPECT_EQ(mesh.positions.size(), ball.positions.size());
  ASSERT_EQ(mesh.triangles.size(), ball.indices.size() / 3);
  EXPECT_GT(enclosed_volume(mesh), 0);
  EXPECT_EQ(require_manifold(mesh, "sphere").euler, 2);
  ASSERT_EQ(fixtures::corner_uvs(mesh).size(), ball.indices.size());
  for (std::size_t c = 0; c < ball.indices.size(); ++c) {
    const Vec3f& p = mesh.positions[static_cast<std::size_t>(mesh.triangles[c / 3][c % 3])];
    EXPECT_EQ(fixtures::corner_uvs(mesh)[c], uvs_of({p})[0]);
  }
}

TEST(DracoCompression, AttributesThatArentCompressedStayWhereTheyAre) {
  const TestFolder folder;
  TestGltf gltf = draco_compressed(tetrahedron_positions(), {}, tetrahedron_indices(), draco::MESH_SEQUENTIAL_ENCODING);
  const int colors = gltf.add_values(std::vector<float>(12, 0.25F), "VEC3", kFloat);
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  const SourceMesh mesh = import_glb(folder, gltf);
  ASSERT_EQ(fixtures::corner_colors(mesh).size(), 12U);
  EXPECT_EQ(fixtures::corner_colors(mesh)[5], Vec4f(0.25F, 0.25F, 0.25F, 1));
}

TEST(DracoCompression, TrianglesOfAStripAreTrianglesAllTheSame) {
  const TestFolder folder;
  TestGltf gltf =
      draco_compressed(tetrahedron_positions(), {}, tetrahedron_indices(), draco::MESH_EDGEBREAKER_ENCODING);
  gltf.document["meshes"][0]["primitives"][0]["mode"] = 5;
  gltf.document["accessors"][0]["count"] = 6;
  EXPECT_EQ(require_manifold(import_glb(folder, gltf), "strip").euler, 2);
}

TestGltf draco_tetrahedron() {
  return draco_compressed(tetrahedron_positions(), {}, tetrahedron_indices(), draco::MESH_EDGEBREAKER_ENCODING);
}

TEST(DracoCompression, WhatContradictsItselfIsRefusedAndNamed) {
  const TestFolder folder;
  struct Case {
    ExitCode code;
    std::vector<std::string> texts;
    std::function<void(TestGltf& gltf, json& primitive, json& extension)> damage;
  };
  constexpr ExitCode kBroken = ExitCode::kUnusableInput;
  const std::vector<Case> cases{
      {kBroken, {"primitive 0", "bufferView is 7"}, [](TestGltf&, json&, json& e) { e["bufferView"] = 7; }},
      {kBroken, {"primitive 0", "bufferView is missing"}, [](TestGltf&, json&, json& e) { e.erase("bufferView"); }},
      {kBroken, {"primitive 0", "attributes are missing"}, [](TestGltf&, json&, json& e) { e.erase("attributes"); }},
      {kBroken, {"primitive 0", "indices is missing"}, [](TestGltf&, json& p, json&) { p.erase("indices"); }},
      {kBroken, {"POSITION is 9", "doesn't hold"}, [](TestGltf&, json&, json& e) { e["attributes"]["POSITION"] = 9; }},
      {kBroken, {"NORMAL is missing"}, [](TestGltf&, json&, json& e) { e["attributes"]["NORMAL"] = 0; }},
      {kBroken,
       {"12 triangle corners", "counts 15"},
       [](TestGltf& g, json&, json&) { g.document["accessors"][0]["count"] = 15; }},
      {kBroken, {"4 POSITION", "counts 5"}, [](TestGltf& g, json&, json&) { g.document["accessors"][1]["count"] = 5; }},
      {kBroken,
       {"3 components of POSITION", "VEC2"},
       [](TestGltf& g, json&, json&) { g.document["accessors"][1]["type"] = "VEC2"; }},
      {kBroken,
       {"accessor 1", "componentType"},
       [](TestGltf& g, json&, json&) { g.document["accessors"][1]["componentType"] = 5124; }},
      {kBroken, {"no triangles"}, [](TestGltf&, json& p, json&) { p["mode"] = 1; }},
      {kBroken, {"header is damaged"}, [](TestGltf& g, json&, json&) { g.bytes[0] = 'X'; }},
      {kBroken, {"but points"}, [](TestGltf& g, json&, json&) { g.bytes[7] = 0; }},
      {ExitCode::kUnsupported, {"version 1.2"}, [](TestGltf& g, json&, json&) { g.bytes[5] = 1; }},
      {kBroken,
       {"header is damaged"},
       [](TestGltf& g, json&, json&) { g.document["bufferViews"][0]["byteLength"] = 12; }},
      {kBroken,
       {"Draco can't decode it"},
       [](TestGltf& g, json&, json&) { g.document["bufferViews"][0]["byteLength"] = 20; }},
  };
  for (const Case& bad : cases) {
    SCOPED_TRACE(bad.texts.back());
    TestGltf gltf = draco_tetrahedron();
    json& primitive = gltf.document["meshes"][0]["primitives"][0];
    bad.damage(gltf, primitive, primitive["extensions"]["KHR_draco_mesh_compression"]);
    expect_refused(folder, gltf, bad.code, bad.texts);
  }
}

TEST(DracoCompression, MoreTrianglesThanAllowedAreRefusedBeforeTheyAreDecoded) {
  expect_refused(TestFolder(), draco_tetrahedron(), ExitCode::kLimit, {"mesh 0 primitive 0", "--max-triangles"},
                 {.max_triangles = 3});
}

TEST(DracoCompression, DamagedBytesAreHarmless) {
  const TestFolder folder;
  const Sphere ball = sphere();
  const auto uvs = uvs_of(ball.positions);
  expect_damage_is_harmless(folder,
                            draco_compressed(ball.positions, uvs, ball.indices, draco::MESH_SEQUENTIAL_ENCODING), 3);
  expect_damage_is_harmless(folder,
                            draco_compressed(ball.positions, uvs, ball.indices, draco::MESH_EDGEBREAKER_ENCODING), 4);
}

}  // namespace
}  // namespace lozenge
