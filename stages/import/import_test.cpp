#include "stages/import/import.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "formats/base/error.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/source_mesh_file.h"
#include "formats/surface/attribute_fixtures.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/surface.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

SourceMesh import_bytes(const TestFolder& folder, const std::string& name, const std::string& bytes,
                        ImportReport* report = nullptr) {
  write_bytes(folder / name, bytes);
  return import_asset(folder / name, {}, {}, report);
}

SourceMesh import_glb(const TestFolder& folder, TestGltf gltf, ImportReport* report = nullptr) {
  return import_bytes(folder, "asset.glb", gltf.glb(), report);
}

/// Each placement of a mesh with a surface of its own.
SourceMesh import_separately(const TestFolder& folder, TestGltf gltf, ImportReport* report = nullptr) {
  write_bytes(folder / "asset.glb", gltf.glb());
  return import_asset(folder / "asset.glb", {.instances = Instances::kSeparate}, {}, report);
}

TEST(ImportGltf, GivesTheSameSurfaceFromEveryContainer) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  const SourceMesh expected = import_bytes(folder, "a.glb", gltf.glb());
  ASSERT_EQ(expected.positions.size(), 4U);
  ASSERT_EQ(expected.triangles.size(), 4U);
  EXPECT_GT(enclosed_volume(expected), 0);

  std::filesystem::create_directories(folder / "below");
  write_bytes(folder / "beside.bin", gltf.bytes);
  write_bytes(folder / "below/with space.bin", gltf.bytes + "more than is needed");
  expect_same_mesh(expected, import_bytes(folder, "b.gltf", gltf.gltf("beside.bin")));
  expect_same_mesh(expected, import_bytes(folder, "c.gltf", gltf.gltf("below/with%20space.bin")));
  expect_same_mesh(expected, import_bytes(folder, "d.gltf", gltf.gltf(gltf.data_uri())));
  expect_same_mesh(expected, import_bytes(folder, "e.gltf", "\xEF\xBB\xBF\n" + gltf.gltf(gltf.data_uri())));
  EXPECT_EQ(import_asset(folder / "d.gltf").origin, "d.gltf");
  EXPECT_EQ(import_asset(folder / "d.gltf").scene_name, "d");
  EXPECT_EQ(import_asset(folder / "d.gltf").generator, "a test");
}

TEST(ImportGltf, ReadsEveryIndexTypeAndNone) {
  const TestFolder folder;
  const SourceMesh expected = import_glb(folder, tetrahedron());
  const auto with_indices = [&](auto zero, int component_type) {
    using T = decltype(zero);
    TestGltf gltf = tetrahedron();
    const auto indices = tetrahedron_indices();
    gltf.document["meshes"][0]["primitives"][0]["indices"] =
        gltf.add_values(std::vector<T>(indices.begin(), indices.end()), "SCALAR", component_type);
    return import_glb(folder, gltf);
  };
  expect_same_mesh(expected, with_indices(std::uint8_t{}, kUnsignedByte));
  expect_same_mesh(expected, with_indices(std::uint16_t{}, kUnsignedShort));

  TestGltf gltf;
  std::vector<Vec3f> soup;
  for (const std::uint32_t i : tetrahedron_indices()) soup.push_back(tetrahedron_positions()[i]);
  const int p = gltf.add_values(TestGltf::flat(soup), "VEC3", kFloat);
  gltf.add_node({{"mesh", gltf.add_mesh({{{"attributes", {{"POSITION", p}}}}})}});
  expect_same_mesh(expected, import_glb(folder, gltf));
}

TEST(ImportGltf, TakesStripsAndFansApartWithTheirOrientation) {
  const TestFolder folder;
  const std::vector<Vec3f> bipyramid{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  TestGltf fans;
  const int positions = fans.add_values(TestGltf::flat(bipyramid), "VEC3", kFloat);
  const int upper = fans.add_values(std::vector<std::uint16_t>{0, 1, 2, 3, 4, 1}, "SCALAR", kUnsignedShort);
  const int lower = fans.add_values(std::vector<std::uint16_t>{5, 1, 4, 3, 2, 1}, "SCALAR", kUnsignedShort);
  const json attributes = {{"POSITION", positions}};
  fans.add_node({{"mesh", fans.add_mesh({{{"attributes", attributes}, {"indices", upper}, {"mode", 6}},
                                         {{"attributes", attributes}, {"indices", lower}, {"mode", 6}}})}});
  const SourceMesh octahedron = import_glb(folder, fans);
  EXPECT_EQ(octahedron.triangles.size(), 8U);
  EXPECT_GT(enclosed_volume(octahedron), 0);
  EXPECT_EQ(require_manifold(octahedron, "fans").boundary_edges, 0);

  // A strip around a tetrahedron: every second triangle is stored the other way round.
  TestGltf strip;
  const int corners = strip.add_values(TestGltf::flat(tetrahedron_positions()), "VEC3", kFloat);
  const int around = strip.add_values(std::vector<std::uint16_t>{0, 1, 3, 2, 0, 1}, "SCALAR", kUnsignedShort);
  strip.add_node(
      {{"mesh", strip.add_mesh({{{"attributes", {{"POSITION", corners}}}, {"indices", around}, {"mode", 5}}})}});
  const SourceMesh tetrahedron = import_glb(folder, strip);
  EXPECT_EQ(tetrahedron.triangles.size(), 4U);
  EXPECT_GT(enclosed_volume(tetrahedron), 0);
  EXPECT_EQ(require_manifold(tetrahedron, "strip").boundary_edges, 0);
}

TEST(ImportGltf, ReplacesTheElementsThatASparseAccessorNames) {
  const TestFolder folder;
  const SourceMesh expected = import_glb(folder, tetrahedron());
  const auto sparse_part = [](TestGltf& gltf, const std::vector<std::uint16_t>& targets) {
    std::vector<Vec3f> values;
    for (const std::uint16_t t : targets) values.push_back(tetrahedron_positions()[t]);
    const int indices = gltf.add_view(targets);
    const int replaced = gltf.add_view(TestGltf::flat(values));
    return json{{"count", targets.size()},
                {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                {"values", {{"bufferView", replaced}}}};
  };
  TestGltf over_values = tetrahedron();
  auto wrong = tetrahedron_positions();
  wrong[1] = wrong[3] = Vec3f(9, 9, 9);
  const int base = over_values.add_view(TestGltf::flat(wrong));
  const json part = sparse_part(over_values, {1, 3});
  over_values.document["accessors"][0]["bufferView"] = base;
  over_values.document["accessors"][0]["sparse"] = part;
  expect_same_mesh(expected, import_glb(folder, over_values));

  TestGltf over_zeros = tetrahedron();
  const json all = sparse_part(over_zeros, {0, 1, 2, 3});
  over_zeros.document["accessors"][0].erase("bufferView");
  over_zeros.document["accessors"][0]["sparse"] = all;
  expect_same_mesh(expected, import_glb(folder, over_zeros));
}

TEST(ImportGltf, ReadsInterleavedAttributes) {
  const TestFolder folder;
  std::vector<float> interleaved;
  for (const Vec3f& p : tetrahedron_positions())
    interleaved.insert(interleaved.end(), {p.x, p.y, p.z, p.x * 2, p.y * 3});
  TestGltf gltf = tetrahedron();
  const int view = gltf.add_view(interleaved, 20);
  gltf.document["accessors"][0]["bufferView"] = view;
  const int uv = gltf.add_accessor(
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", kFloat}, {"type", "VEC2"}, {"count", 4}});
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv;
  const SourceMesh mesh = import_glb(folder, gltf);
  ASSERT_EQ(fixtures::corner_uvs(mesh).size(), 12U);
  for (std::size_t c = 0; c < 12; ++c) {
    const Vec3f p = mesh.positions[mesh.triangles[c / 3][c % 3]];
    EXPECT_EQ(fixtures::corner_uvs(mesh)[c], Vec2f(p.x * 2, p.y * 3));
  }
}

TEST(ImportGltf, ScalesNormalizedIntegersToUnitRange) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] =
      gltf.add_values(std::vector<std::uint16_t>{0, 65535, 0, 65535, 0, 65535, 0, 65535}, "VEC2", kUnsignedShort, true);
  // Three components of a byte each, padded to four bytes as the specification wants it.
  const std::vector<std::uint8_t> colors{255, 0, 51, 7, 255, 0, 51, 7, 255, 0, 51, 7, 255, 0, 51, 7};
  const int view = gltf.add_view(colors, 4);
  attributes["COLOR_0"] = gltf.add_accessor(
      {{"bufferView", view}, {"componentType", kUnsignedByte}, {"normalized", true}, {"type", "VEC3"}, {"count", 4}});
  const SourceMesh mesh = import_glb(folder, gltf);
  for (std::size_t c = 0; c < 12; ++c) {
    EXPECT_EQ(fixtures::corner_uvs(mesh)[c], Vec2f(0, 1));
    EXPECT_EQ(fixtures::corner_colors(mesh)[c], Vec4f(1, 0, 0.2F, 1));
  }
}

TEST(ImportGltf, ReadsQuantizedPositionsOfEveryIntegerType) {
  const TestFolder folder;
  const auto quantized = [&](auto zero, int component_type, bool normalized) {
    using T = decltype(zero);
    // One element takes a multiple of four bytes.
    const int stride = sizeof(T) == 1 ? 4 : 8;
    std::vector<T> values;
    for (const Vec3f& p : tetrahedron_positions()) {
      const T most = std::numeric_limits<T>::max();
      for (int axis = 0; axis < 3; ++axis) values.push_back(p[axis] > 0 ? most : T{});
      values.push_back(T{});
    }
    TestGltf gltf = tetrahedron();
    const int view = gltf.add_view(values, stride);
    json& accessor = gltf.document["accessors"][0];
    accessor["bufferView"] = view;
    accessor["componentType"] = component_type;
    accessor["normalized"] = normalized;
    gltf.document["extensionsUsed"] = gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const SourceMesh mesh = import_glb(folder, gltf);
    const float one = normalized ? 1.0F : static_cast<float>(std::numeric_limits<T>::max());
    EXPECT_EQ(mesh.positions[0], Vec3f(one, one, one));
    EXPECT_EQ(mesh.positions[1], Vec3f(0, 0, one));
    EXPECT_EQ(require_manifold(mesh, "quantized").euler, 2);
  };
  for (const bool normalized : {false, true}) {
    quantized(std::int8_t{}, kByte, normalized);
    quantized(std::uint8_t{}, kUnsignedByte, normalized);
    quantized(std::int16_t{}, kShort, normalized);
    quantized(std::uint16_t{}, kUnsignedShort, normalized);
  }
}

TEST(ImportGltf, AppliesAQuaternionAsTheMatrixThatItStandsFor) {
  const TestFolder folder;
  const double half = std::numbers::pi / 4;
  // A quarter turn about z takes x to y; scaled first, shifted last.
  TestGltf trs = tetrahedron();
  trs.document["nodes"][0]["rotation"] = {0, 0, std::sin(half), std::cos(half)};
  trs.document["nodes"][0]["scale"] = {2, 3, 4};
  trs.document["nodes"][0]["translation"] = {10, 20, 30};
  const SourceMesh turned = import_glb(folder, trs);
  const SourceMesh plain = import_glb(folder, tetrahedron());
  TestGltf matrix = tetrahedron();
  matrix.document["nodes"][0]["matrix"] = {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1};
  const SourceMesh by_matrix = import_glb(folder, matrix);
  for (std::size_t v = 0; v < plain.positions.size(); ++v) {
    const Vec3f p = plain.positions[v];
    const Vec3f expected(10 - 3 * p.y, 20 + 2 * p.x, 30 + 4 * p.z);
    EXPECT_LT((turned.positions[v] - expected).length(), 1e-5);
    EXPECT_EQ(by_matrix.positions[v], expected);
  }
}

TEST(ImportGltf, ComposesTheTransformsOfNestedNodesFromTheLeafUp) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  gltf.document["nodes"][0]["translation"] = {1, 0, 0};
  const int middle = gltf.add_node({{"children", {0}}, {"scale", {2, 2, 2}}});
  const int root = gltf.add_node({{"children", {middle}}, {"translation", {0, 5, 0}}});
  gltf.document["scenes"] = {{{"nodes", {root}}}};
  EXPECT_EQ(import_glb(folder, gltf).positions[0], Vec3f(4, 7, 2));
}

TEST(ImportGltf, TurnsTheTrianglesOfMirroringNodes) {
  const TestFolder folder;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> scale(-3, 3);
  for (int i = 0; i < 50; ++i) {
    TestGltf gltf = tetrahedron();
    gltf.document["nodes"][0]["scale"] = {scale(random), scale(random), scale(random)};
    EXPECT_GT(enclosed_volume(import_glb(folder, gltf)), 0);
  }
}

TEST(ImportGltf, WeldsAHalfAndItsMirrorImageIntoAClosedSurface) {
  const TestFolder folder;
  // The upper half of an octahedron, open below, and once more upside down; the rim has z = +0 here and -0 there.
  TestGltf gltf;
  gltf.add_simple_mesh({{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1});
  gltf.add_node({{"mesh", 0}, {"scale", {1, 1, -1}}});
  ImportReport report;
  const SourceMesh mesh = import_glb(folder, gltf, &report);
  EXPECT_EQ(report.instances, 2);
  EXPECT_EQ(mesh.positions.size(), 6U);
  EXPECT_GT(enclosed_volume(mesh), 0);
  EXPECT_EQ(require_manifold(mesh, "octahedron").components, 1);
  EXPECT_EQ(require_manifold(mesh, "octahedron").boundary_edges, 0);
}

TEST(ImportGltf, CountsMeshesThatArePlacedMoreThanOnceAndSaysSo) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  gltf.add_node({{"mesh", 0}, {"translation", {5, 0, 0}}});
  gltf.add_simple_mesh({{9, 1, 1}, {7, -1, 1}, {7, 1, -1}, {9, -1, -1}}, tetrahedron_indices());
  ImportReport report;
  EXPECT_EQ(import_separately(folder, gltf, &report).triangles.size(), 12U);
  EXPECT_EQ(report.instances, 3);
  EXPECT_EQ(report.repeated_instances, 2);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_EQ(report.notes[0].find("2 placements"), 0U) << report.notes[0];
}

/// A tetrahedron whose node has EXT_mesh_gpu_instancing, with these properties of floats.
TestGltf instanced(const std::map<std::string, std::vector<float>>& properties) {
  TestGltf gltf = tetrahedron();
  json attributes = json::object();
  for (const auto& [name, values] : properties) {
    attributes[name] = gltf.add_values(values, name == "ROTATION" ? "VEC4" : "VEC3", kFloat);
  }
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  gltf.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return gltf;
}

TEST(ImportGltf, PlacesInstancesOfAnExtensionAsNodesWouldBePlaced) {
  const TestFolder folder;
  const float h = std::sqrt(0.5F);
  TestGltf by_extension = instanced({{"TRANSLATION", {0, 0, 0, 5, 6, 7, 10, 0, 0}},
                                     {"ROTATION", {0, 0, 0, 1, 0, 0, h, h, h, 0, 0, h}},
                                     {"SCALE", {1, 1, 1, 2, 1, 1, 1, 1, -1}}});
  TestGltf by_nodes = tetrahedron();
  by_nodes.document["nodes"] = {
      {{"mesh", 0}},
      {{"mesh", 0}, {"translation", {5, 6, 7}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 1, 1}}},
      {{"mesh", 0}, {"translation", {10, 0, 0}}, {"rotation", {h, 0, 0, h}}, {"scale", {1, 1, -1}}}};
  const json moved = {{"children", {0}}, {"translation", {1, 2, 3}}, {"scale", {3, 1, 2}}};
  by_extension.add_node(moved);
  by_nodes.add_node(moved);
  by_nodes.document["nodes"][3]["children"] = {0, 1, 2};
  ImportReport report;
  const SourceMesh mesh = import_separately(folder, by_extension, &report);
  EXPECT_EQ(report.instances, 3);
  EXPECT_EQ(report.repeated_instances, 3);
  expect_same_mesh(mesh, import_separately(folder, by_nodes));
}

TEST(ImportGltf, InstancesOfAnExtensionThatContradictThemselvesAreRefused) {
  const TestFolder folder;
  const auto refuse = [&](TestGltf gltf, const std::string& text) {
    try {
      import_glb(folder, std::move(gltf));
      ADD_FAILURE() << "not refused: " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("node 0"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  refuse(instanced({{"TRANSLATION", {0, 0, 0}}, {"SCALE", {1, 1, 1, 2, 2, 2}}}), "differ in their number");
  refuse(instanced({{"ROTATION", {0, 0, 0, 0}}}), "rotation");
  refuse(instanced({{"TRANSLATION", {INFINITY, 0, 0}}}), "not finite");
  TestGltf gltf = instanced({{"TRANSLATION", {0, 0, 0}}});
  json& attributes = gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = 1;  // the indices
  refuse(gltf, "TRANSLATION");
  attributes["TRANSLATION"] = 77;
  refuse(gltf, "TRANSLATION is 77");
  attributes = 5;
  refuse(gltf, "not a JSON object");
}

/// 200 triangles, each a primitive, all of one accessor of 20,000 vertices.
TestGltf triangles_of_one_accessor(bool sparse) {
  TestGltf gltf;
  std::vector<float> positions;
  for (int i = 0; i < 20'000; ++i) {
    positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i % 3), static_cast<float>(i % 2)});
  }
  const int position = gltf.add_values(positions, "VEC3", kFloat);
  const int colour = gltf.add_values(std::vector<float>(80'000, 0.5F), "VEC4", kFloat);
  if (sparse) {
    const int indices = gltf.add_view(std::vector<std::uint16_t>{1, 600, 19'999});
    const int values = gltf.add_view(std::vector<float>{7, 7, 7, 8, 8, 8, 9, 9, 9});
    gltf.document["accessors"][position]["sparse"] = {
        {"count", 3},
        {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
        {"values", {{"bufferView", values}}}};
  }
  json primitives = json::array();
  for (std::uint32_t t = 0; t < 200; ++t) {
    const std::vector<std::uint32_t> corners{3 * t + 2, 3 * t, 3 * t + 1};
    primitives.push_back({{"attributes", {{"POSITION", position}, {"COLOR_0", colour}}},
                          {"indices", gltf.add_values(corners, "SCALAR", kUnsignedInt)}});
  }
  gltf.add_node({{"mesh", gltf.add_mesh(primitives)}});
  return gltf;
}

TEST(ImportGltf, PrimitivesThatShareAccessorsCostWhatTheyUse) {
  const TestFolder folder;
  for (const bool sparse : {false, true}) {
    TestGltf shared = triangles_of_one_accessor(sparse);
    write_bytes(folder / "shared.glb", shared.glb());
    // 200 times 20,000 vertices would take 600 MB.
    const SourceMesh mesh = import_asset(folder / "shared.glb", {.max_memory = 4'000'000});
    json& primitives = shared.document["meshes"][0]["primitives"];
    std::vector<std::uint32_t> all;
    for (std::uint32_t t = 0; t < 200; ++t) all.insert(all.end(), {3 * t + 2, 3 * t, 3 * t + 1});
    for (int i = 0; i < 60'000; ++i) all.push_back(0);  // uses so many corners that it is read as a whole
    TestGltf whole = triangles_of_one_accessor(sparse);
    whole.document["meshes"][0]["primitives"] = json::array({primitives[0]});
    whole.document["meshes"][0]["primitives"][0]["indices"] = whole.add_values(all, "SCALAR", kUnsignedInt);
    expect_same_mesh(mesh, import_glb(folder, whole));
  }
}

TEST(ImportGltf, NamesWhatItLeavesOut) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  gltf.document["scenes"] = {{{"nodes", {0}}}, {{"nodes", json::array()}}, {{"name", "empty"}}};
  gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  gltf.document["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
                                  {"samplers", {{{"input", 0}, {"output", 0}}}}}};
  gltf.document["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}, {{"type", "point"}}}}}}};
  gltf.document["extensionsUsed"] = {"KHR_lights_punctual", "ACME_teapots", "ACME_cups"};
  ImportReport report;
  import_glb(folder, gltf, &report);
  ASSERT_EQ(report.notes.size(), 2U);
  EXPECT_EQ(report.notes[0], "left out: 2 other scenes, 1 camera, 2 lights, 1 animation");
  EXPECT_NE(report.notes[1].find("ACME_teapots, ACME_cups"), std::string::npos) << report.notes[1];
}

TEST(ImportGltf, TakesTheDefaultSceneAndElseTheFirst) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  gltf.add_node({{"mesh", 0}, {"translation", {5, 0, 0}}});
  EXPECT_EQ(import_separately(folder, gltf).triangles.size(), 8U) << "without a scene, all root nodes";
  gltf.document["scenes"] = {{{"nodes", {0}}, {"name", "first"}}, {{"nodes", {1}}, {"name", "second"}}};
  EXPECT_EQ(import_glb(folder, gltf).scene_name, "first");
  EXPECT_EQ(import_glb(folder, gltf).positions[0].x, 1);
  gltf.document["scene"] = 1;
  EXPECT_EQ(import_glb(folder, gltf).scene_name, "second");
  EXPECT_EQ(import_glb(folder, gltf).positions[0].x, 6);
}

TEST(ImportGltf, SortsTrianglesByMaterialAndNamesTheMissingOne) {
  const TestFolder folder;
  TestGltf gltf;
  const int p = gltf.add_values(TestGltf::flat(tetrahedron_positions()), "VEC3", kFloat);
  json primitives;
  const auto indices = tetrahedron_indices();
  const std::vector<int> materials{1, -1, 0, 1};
  for (std::size_t t = 0; t < 4; ++t) {
    const std::vector<std::uint32_t> corners(indices.begin() + 3 * static_cast<long>(t),
                                             indices.begin() + 3 * static_cast<long>(t) + 3);
    primitives.push_back(
        {{"attributes", {{"POSITION", p}}}, {"indices", gltf.add_values(corners, "SCALAR", kUnsignedInt)}});
    if (materials[t] >= 0) primitives.back()["material"] = materials[t];
  }
  gltf.document["materials"] = {{{"name", "skin"}}, {{"doubleSided", true}}};
  gltf.add_node({{"mesh", gltf.add_mesh(primitives)}});
  const SourceMesh mesh = import_glb(folder, gltf);
  EXPECT_EQ(mesh.materials, (std::vector<std::int32_t>{0, 1, 1, 2}));
  EXPECT_EQ(mesh.material_names, (std::vector<std::string>{"skin", "", "default"}));
  EXPECT_EQ(mesh.double_sided, (std::vector<bool>{false, true, false}));
  EXPECT_EQ(mesh.triangles[0], (std::array<VertexId, 3>{0, 1, 2})) << "numbered by first use, after sorting";
}

TEST(ImportGltf, FillsAttributesThatOnlySomePrimitivesHave) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  const int p = 0;
  const int uv = gltf.add_values(std::vector<float>(8, 0.5F), "VEC2", kFloat);
  const int n = gltf.add_values(std::vector<float>{0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2}, "VEC3", kFloat);
  const int c = gltf.add_values(std::vector<float>(12, 0.25F), "VEC3", kFloat);
  json& primitives = gltf.document["meshes"][0]["primitives"];
  const json all = {{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", uv}, {"COLOR_0", c}}},
                    {"indices", 1}};
  primitives = {primitives[0], all, primitives[0]};
  const SourceMesh mesh = import_glb(folder, gltf);
  ASSERT_EQ(mesh.triangles.size(), 12U);
  for (std::size_t corner = 0; corner < 36; ++corner) {
    const bool has = corner / 12 == 1;
    EXPECT_EQ(fixtures::corner_normals(mesh)[corner], has ? Vec3f(0, 0, 1) : Vec3f(0, 0, 0));
    EXPECT_EQ(fixtures::corner_uvs(mesh)[corner], has ? Vec2f(0.5, 0.5) : Vec2f(0, 0));
    EXPECT_EQ(fixtures::corner_colors(mesh)[corner], has ? Vec4f(0.25, 0.25, 0.25, 1) : Vec4f(1, 1, 1, 1));
  }
}

TEST(ImportGltf, KeepsNormalsPerpendicularAndUnitUnderAnyTransform) {
  const TestFolder folder;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int i = 0; i < 50; ++i) {
    // Flat shading: three vertices a triangle, each with the triangle's normal.
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;
    for (const std::uint32_t v : tetrahedron_indices()) positions.push_back(tetrahedron_positions()[v]);
    for (std::size_t k = 0; k < 12; k += 3) {
      normals.insert(normals.end(), 3,
                     ((positions[k + 1] - positions[k]).cross(positions[k + 2] - positions[k])).normalized());
    }
    TestGltf gltf;
    const int p = gltf.add_values(TestGltf::flat(positions), "VEC3", kFloat);
    const int n = gltf.add_values(TestGltf::flat(normals), "VEC3", kFloat);
    json node = {{"mesh", gltf.add_mesh({{{"attributes", {{"POSITION", p}, {"NORMAL", n}}}}})}};
    for (int k = 0; k < 16; ++k) node["matrix"].push_back(k % 4 == 3 ? (k == 15 ? 1.0 : 0.0) : number(random));
    gltf.add_node(node);
    const SourceMesh mesh = import_glb(folder, gltf);
    ASSERT_EQ(mesh.triangles.size(), 4U);
    for (std::size_t c = 0; c < 12; ++c) {
      const auto& [a, b, d] = mesh.triangles[c / 3];
      const Vec3d edge(mesh.positions[b] - mesh.positions[a]);
      const Vec3d other(mesh.positions[d] - mesh.positions[a]);
      const Vec3d normal(fixtures::corner_normals(mesh)[c]);
      EXPECT_NEAR(normal.length(), 1, 1e-6);
      EXPECT_GT(normal.dot(edge.cross(other).normalized()), 1 - 1e-4);
    }
  }
}

TEST(ImportGltf, ReplacesAttributesThatAreNoNumbersAndCountsThem) {
  const TestFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  TestGltf gltf = tetrahedron();
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = gltf.add_values(std::vector<float>{nan, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", kFloat);
  attributes["TEXCOORD_0"] = gltf.add_values(std::vector<float>{0, INFINITY, 0, 0, 0, 0, 0, 0}, "VEC2", kFloat);
  attributes["COLOR_0"] = gltf.add_values(std::vector<float>{2, -1, nan, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", kFloat);
  ImportReport report;
  const SourceMesh mesh = import_glb(folder, gltf, &report);
  EXPECT_EQ(report.repaired_attributes, 3);
  EXPECT_EQ(fixtures::corner_normals(mesh)[0], Vec3f(0, 0, 0));
  EXPECT_EQ(fixtures::corner_uvs(mesh)[0], Vec2f(0, 0));
  EXPECT_EQ(fixtures::corner_colors(mesh)[0], Vec4f(1, 0, 1, 1));
}

TEST(ImportGltf, LeavesOutPointsLinesAndTrianglesOfCoincidingCornersAndCountsThem) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  json& primitives = gltf.document["meshes"][0]["primitives"];
  for (const int mode : {0, 1, 2, 3}) primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  auto positions = tetrahedron_positions();
  positions.push_back(positions[0]);
  const int p = gltf.add_values(TestGltf::flat(positions), "VEC3", kFloat);
  const int i = gltf.add_values(std::vector<std::uint32_t>{0, 1, 1, 0, 4, 2}, "SCALAR", kUnsignedInt);
  primitives.push_back({{"attributes", {{"POSITION", p}}}, {"indices", i}});
  ImportReport report;
  const SourceMesh mesh = import_glb(folder, gltf, &report);
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(report.ignored_primitives, 4);
  EXPECT_EQ(report.dropped_triangles, 2);
  EXPECT_EQ(report.repairs[RepairKind::kDegenerateTriangles].count, 2);
  EXPECT_EQ(report.notes.size(), 1U);
}

TEST(ImportGltf, LetsWhatHasASkinButNoJointsStandWhereItsNodeDoes) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  gltf.document["nodes"][0]["skin"] = 0;
  gltf.document["nodes"][0]["translation"] = {7, 7, 7};
  gltf.document["skins"] = {{{"joints", {0}}}};
  ImportReport report;
  EXPECT_EQ(import_glb(folder, gltf, &report).positions[0], Vec3f(8, 8, 8));
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("has a skin, but no joints or weights"), std::string::npos);
}

TEST(ImportGltf, NeitherReadsNorNeedsImages) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  const int not_a_picture = gltf.add_view(std::vector<std::uint8_t>{1, 2, 3});
  gltf.document["images"] = {{{"uri", "nowhere.png"}},
                             {{"uri", "data:image/png;base64,AAAA"}},
                             {{"bufferView", not_a_picture}, {"mimeType", "image/png"}}};
  gltf.document["textures"] = {{{"source", 0}}, {{"source", 2}}};
  gltf.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  EXPECT_EQ(import_glb(folder, gltf).triangles.size(), 4U);
}

TEST(ImportGltf, GivesTheSameMeshFromTheFileThatItsMeshIsWrittenTo) {
  const TestFolder folder;
  std::mt19937 random(23);
  std::uniform_real_distribution<float> number(-2, 2);
  for (int i = 0; i < 30; ++i) {
    TestGltf gltf = tetrahedron();
    json& primitives = gltf.document["meshes"][0]["primitives"];
    std::vector<float> normals(12);
    std::vector<float> uvs(8);
    for (float& x : normals) x = number(random);
    for (float& x : uvs) x = number(random);
    json attributes = primitives[0]["attributes"];
    attributes["NORMAL"] = gltf.add_values(normals, "VEC3", kFloat);
    attributes["TEXCOORD_0"] = gltf.add_values(uvs, "VEC2", kFloat);
    primitives.push_back({{"attributes", attributes}, {"indices", 1}, {"material", 0}});
    if (i % 2 == 0) primitives[0]["material"] = 1;
    gltf.document["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
    gltf.document["nodes"][0]["rotation"] = {0.1 * i, 0.2, -0.3, 0.9};
    gltf.document["nodes"][0]["scale"] = {1, 1 + i, -0.5};
    const SourceMesh mesh = import_glb(folder, gltf);
    write_source_mesh(folder / "written.glb", mesh);
    const SourceMesh again = import_asset(folder / "written.glb");
    expect_same_mesh(mesh, again);
    EXPECT_EQ(again.origin, "asset.glb");
    EXPECT_EQ(again.generator, "a test");
    EXPECT_EQ(again.scene_name, mesh.scene_name);
    expect_same_mesh(mesh, read_source_mesh(folder / "written.glb"));
  }
}

TEST(ImportGltf, ReportsItsProgressFromZeroToOne) {
  const TestFolder folder;
  write_bytes(folder / "asset.glb", tetrahedron().glb());
  std::vector<double> done;
  import_asset(folder / "asset.glb", {}, [&](std::string_view, double share) { done.push_back(share); });
  ASSERT_FALSE(done.empty());
  EXPECT_EQ(done.front(), 0);
  EXPECT_EQ(done.back(), 1);
}

}  // namespace
}  // namespace lozenge
