// Writes the files that fuzzing starts from: one folder for each target, some small files of every kind it reads.
//
// Usage: write_fuzz_corpus FOLDER
#include <cstdio>
#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "formats/files/asset_file.h"
#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/map_mips_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/source_mesh_file.h"
#include "formats/patches/image_fixtures.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/body_fixtures.h"
#include "stages/import/gltf_fixtures.h"
#include "tests/fuzz/mesh_corpus.h"
#include "tests/fuzz/painted_corpus.h"
// After test_gltf.h, which it builds on.
#include "stages/import/compression_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;
using namespace testing_gltf;

fs::path folder_for(const fs::path& root, const char* target) {
  fs::create_directories(root / target);
  return root / target;
}

TestGltf quantized() {
  TestGltf gltf;
  const std::vector<std::int16_t> positions{1, 1, 1, 0, -1, -1, 1, 0, -1, 1, -1, 0, 1, -1, -1, 0};
  const int view = gltf.add_view(positions, 8);
  const int p = gltf.add_accessor({{"bufferView", view}, {"componentType", kShort}, {"type", "VEC3"}, {"count", 4}});
  const int i = gltf.add_values(tetrahedron_indices(), "SCALAR", kUnsignedInt);
  gltf.add_node({{"mesh", gltf.add_mesh({{{"attributes", {{"POSITION", p}}}, {"indices", i}}})}});
  gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  return gltf;
}

TestGltf sparse() {
  TestGltf gltf = tetrahedron();
  const int indices = gltf.add_view(std::vector<std::uint16_t>{1, 3});
  const int values = gltf.add_view(std::vector<float>{-1, -1, 1, 1, -1, -1});
  gltf.document["accessors"][0]["sparse"] = {{"count", 2},
                                             {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                                             {"values", {{"bufferView", values}}}};
  return gltf;
}

TestGltf strips_and_fans() {
  TestGltf gltf;
  const int p = gltf.add_values(TestGltf::flat(tetrahedron_positions()), "VEC3", kFloat);
  const int i = gltf.add_values(std::vector<std::uint16_t>{0, 1, 3, 2, 0, 1}, "SCALAR", kUnsignedShort);
  json primitives;
  for (const int mode : {5, 6, 1}) {
    primitives.push_back({{"attributes", {{"POSITION", p}}}, {"indices", i}, {"mode", mode}});
  }
  gltf.add_node({{"mesh", gltf.add_mesh(primitives)}});
  return gltf;
}

/// All that the importer looks at, at once.
TestGltf furnished() {
  TestGltf gltf = tetrahedron();
  json& primitive = gltf.document["meshes"][0]["primitives"][0];
  const int normals = gltf.add_values(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0}, "VEC3", kFloat);
  const int uvs = gltf.add_values(std::vector<std::uint8_t>{0, 9, 99, 255, 1, 2, 3, 4}, "VEC2", kUnsignedByte, true);
  const int colors = gltf.add_values(std::vector<float>(16, 0.5F), "VEC4", kFloat);
  const int moves = gltf.add_values(std::vector<float>{0, 0, 0, 5, 0, 0}, "VEC3", kFloat);
  primitive["attributes"].update({{"NORMAL", normals}, {"TEXCOORD_0", uvs}, {"COLOR_0", colors}});
  primitive["targets"] = {{{"POSITION", 0}}};
  primitive["material"] = 0;
  json& node = gltf.document["nodes"][0];
  node["scale"] = {1, -2, 1};
  node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = moves;
  gltf.add_node({{"mesh", 0}, {"skin", 0}, {"rotation", {0, 0, 0, 1}}});
  gltf.add_node({{"children", {0, 1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1}}});
  gltf.document["skins"] = {{{"joints", {0}}}};
  gltf.document["materials"] = {{{"name", "skin"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["images"] = {{{"uri", "a.png"}}};
  gltf.document["scenes"] = {{{"nodes", {2}}, {"name", "main"}}, {{"name", "other"}}};
  gltf.document["scene"] = 0;
  gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  gltf.document["extensionsUsed"] = {"ACME_teapots"};
  return gltf;
}

TestGltf filtered() {
  TestGltf gltf;
  const auto positions = TestGltf::flat(tetrahedron_positions());
  std::vector<std::uint32_t> exponential(12);
  meshopt_encodeFilterExp(exponential.data(), 4, 12, 23, positions.data());
  std::vector<float> with_w;
  for (const Vec3f& p : tetrahedron_positions()) with_w.insert(with_w.end(), {p.x, p.y, p.z, 0});
  std::vector<std::uint8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, with_w.data());
  const int position_view = gltf.add_view(exponential);
  const int normal_view = gltf.add_view(octahedral, 4);
  const int p =
      gltf.add_accessor({{"bufferView", position_view}, {"componentType", kFloat}, {"type", "VEC3"}, {"count", 4}});
  const int n = gltf.add_accessor(
      {{"bufferView", normal_view}, {"componentType", kByte}, {"normalized", true}, {"type", "VEC3"}, {"count", 4}});
  const int i = gltf.add_values(tetrahedron_indices(), "SCALAR", kUnsignedInt);
  gltf.add_node({{"mesh", gltf.add_mesh({{{"attributes", {{"POSITION", p}, {"NORMAL", n}}}, {"indices", i}}})}});
  return meshopt_compressed(gltf,
                            {{"ATTRIBUTES", 12, "EXPONENTIAL"}, {"ATTRIBUTES", 4, "OCTAHEDRAL"}, {"INDICES", 4, ""}});
}

/// What the exporter's assets consist of: levels of detail, and a texture in the file.
TestGltf asset_with_texture(const std::string& png) {
  TestGltf gltf = tetrahedron();
  gltf.add_node({{"mesh", 0}});
  gltf.document["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {1};
  json& primitive = gltf.document["meshes"][0]["primitives"][0];
  const int uvs = gltf.add_values(std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1}, "VEC2", kFloat);
  const int normals = gltf.add_values(std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3", kFloat);
  const int tangents =
      gltf.add_values(std::vector<float>{0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}, "VEC4", kFloat);
  primitive["attributes"].update({{"NORMAL", normals}, {"TEXCOORD_0", uvs}, {"TANGENT", tangents}});
  primitive["material"] = 0;
  const int view = gltf.add_view(std::vector<char>(png.begin(), png.end()));
  gltf.document["scenes"] = {{{"nodes", {0}}, {"name", "main"}}};
  gltf.document["materials"] = {{{"normalTexture", {{"index", 0}}}, {"occlusionTexture", {{"index", 0}}}}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  return gltf;
}

/// Three triangles at an edge, a turned one, a duplicate, a flat one, two that touch in a point.
TestGltf damaged() {
  TestGltf gltf;
  gltf.add_simple_mesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 2}, {3, 1, 0}, {3, 2, 0}},
                       {0, 1, 2, 0, 1, 3, 1, 0, 4, 3, 1, 0, 0, 1, 5, 2, 6, 7, 2, 3, 0, 2, 1, 3, 4, 4, 1});
  return gltf;
}

void write_gltf_files(const fs::path& folder) {
  write_bytes(folder / "damaged.glb", damaged().glb());
  write_bytes(folder / "plain.glb", tetrahedron().glb());
  TestGltf embedded = tetrahedron();
  write_bytes(folder / "embedded.gltf", embedded.gltf(embedded.data_uri()));
  write_bytes(folder / "quantized.glb", quantized().glb());
  write_bytes(folder / "sparse.glb", sparse().glb());
  write_bytes(folder / "strips.glb", strips_and_fans().glb());
  write_bytes(folder / "furnished.glb", furnished().glb());
  write_bytes(folder / "meshopt.glb",
              meshopt_compressed(tetrahedron(), {{"ATTRIBUTES", 12, ""}, {"TRIANGLES", 4, ""}}).glb());
  write_bytes(folder / "filtered.glb", filtered().glb());
  const std::vector<Vec2f> uvs{{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    write_bytes(folder / ("draco" + std::to_string(method) + ".glb"),
                draco_compressed(tetrahedron_positions(), uvs, tetrahedron_indices(), method).glb());
  }
}

/// What is placed several times, in every kind of file.
void write_repeats(const fs::path& root) {
  TestGltf gltf = tetrahedron();
  gltf.add_node({{"mesh", 0}, {"translation", {5, 0, 0}}, {"scale", {1, 1, -2}}});
  gltf.add_node({{"mesh", 0}, {"translation", {2, 2, 0}}});
  gltf.add_node({{"mesh", 0}, {"translation", {0, 0, 9}}, {"rotation", {0.6, 0, 0, 0.8}}});
  write_bytes(root / "import" / "repeated.glb", gltf.glb());
  const Body ball{"ball", {{}, {{0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1}, -1}}, -1};
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::tetrahedron(), 1);
  mesh.material_names = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  mesh.bodies = {{ball}, {0}};
  write_source_mesh(root / "source_mesh" / "repeated.glb", mesh);
  write_source_mesh(root / "import" / "repeated_mesh.glb", mesh);
  PatchSet patches = fixtures::sphere_patches(fixtures::tetrahedron(), 1);
  patches.layout.bodies = {{ball}, std::vector(patches.layout.places.size(), 0)};
  write_patch_set(root / "patch_set" / "repeated.exr", patches);
  GeometryImage image = fixtures::sphere_image(fixtures::tetrahedron(), 1);
  image.layout.bodies = patches.layout.bodies;
  write_geometry_image(root / "geometry_image" / "repeated.gim.exr", image);
}

/// A tetrahedron that two joints bend, below nodes that an animation moves, with another one on a joint.
TestGltf skinned() {
  TestGltf gltf = tetrahedron();
  json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = gltf.add_values(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0},
                                           "VEC4", testing_gltf::kUnsignedByte);
  attributes["WEIGHTS_0"] = gltf.add_values(
      std::vector<float>{0.5F, 0.5F, 0, 0, 1, 0, 0, 0, 0.25F, 0.75F, 0, 0, 0, 0, 0, 0}, "VEC4", testing_gltf::kFloat);
  const int view = gltf.add_view(std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                                    2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 1, 0, 1});
  const int binds = gltf.add_accessor(
      {{"bufferView", view}, {"componentType", testing_gltf::kFloat}, {"type", "MAT4"}, {"count", 2}});
  gltf.document["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", binds}, {"skeleton", 1}}};
  gltf.document["nodes"][0]["skin"] = 0;
  gltf.add_node({{"name", "lower"}, {"children", {2}}, {"scale", {0.5, 1, 2}}});
  gltf.add_node({{"name", "upper"}, {"children", {3}}, {"rotation", {0.6, 0, 0, 0.8}}});
  gltf.document["meshes"].push_back(gltf.document["meshes"][0]);
  gltf.add_node({{"name", "prop"}, {"mesh", 1}, {"translation", {3, 4, 5}}});
  const int times = gltf.add_values(std::vector<float>{0, 1}, "SCALAR", testing_gltf::kFloat);
  const int turns = gltf.add_values(std::vector<float>{0.6F, 0, 0, 0.8F, 1, 0, 0, 0}, "VEC4", testing_gltf::kFloat);
  const int shifts = gltf.add_values(std::vector<float>(18, 1), "VEC3", testing_gltf::kFloat);
  gltf.document["animations"] = {{{"name", "bend"},
                                  {"channels",
                                   {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
                                    {{"sampler", 1}, {"target", {{"node", 3}, {"path", "translation"}}}}}},
                                  {"samplers",
                                   {{{"input", times}, {"output", turns}, {"interpolation", "STEP"}},
                                    {{"input", times}, {"output", shifts}, {"interpolation", "CUBICSPLINE"}}}}}};
  gltf.document["scenes"] = {{{"nodes", {0, 1}}}};
  return gltf;
}

/// A tetrahedron with two morph targets, one of them sparse, and an animation of their weights.
TestGltf morphing() {
  TestGltf gltf = tetrahedron();
  gltf.document["asset"]["extras"] = {{"parts", 1}};
  gltf.document["nodes"][0]["weights"] = {0.5, 0};
  const int dense = gltf.add_values(std::vector<float>(12, 0.25F), "VEC3", kFloat);
  const int places = gltf.add_view(std::vector<std::uint16_t>{1, 3});
  const int values = gltf.add_view(std::vector<float>{1, 0, 0, 0, 1, 0});
  const int sparse = gltf.add_accessor({{"componentType", kFloat},
                                        {"type", "VEC3"},
                                        {"count", 4},
                                        {"sparse",
                                         {{"count", 2},
                                          {"indices", {{"bufferView", places}, {"componentType", kUnsignedShort}}},
                                          {"values", {{"bufferView", values}}}}}});
  json& mesh = gltf.document["meshes"][0];
  json& attributes = mesh["primitives"][0]["attributes"];
  attributes["NORMAL"] = dense;
  mesh["primitives"][0]["targets"] = {{{"POSITION", dense}, {"NORMAL", sparse}}, {{"POSITION", sparse}}};
  mesh["weights"] = {0, 1};
  mesh["extras"] = {{"targetNames", {"one", "two"}}};
  const int times = gltf.add_values(std::vector<float>{0, 1}, "SCALAR", kFloat);
  const int keys = gltf.add_values(std::vector<float>{0, 1, 1, 0}, "SCALAR", kFloat);
  gltf.document["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
                                  {"samplers", {{{"input", times}, {"output", keys}}}}}};
  return gltf;
}

/// What moves, in every kind of file.
void write_moving(const fs::path& root) {
  write_bytes(root / "import" / "skinned.glb", skinned().glb());
  TestGltf asset = skinned();
  asset.document["asset"]["extras"] = {{"parts", 2}};
  write_bytes(root / "asset" / "skinned.glb", asset.glb());
  write_bytes(root / "import" / "morphing.glb", morphing().glb());
  write_bytes(root / "asset" / "morphing.glb", morphing().glb());
  std::mt19937 random(5);
  auto [mesh, map] = fixtures::subdivided_sphere(fixtures::tetrahedron(), 1);
  mesh.rig = fixtures::random_rig(random);
  mesh.bodies = {{{"skin", {{kUnmoved, 3}}, 0, {{"grin", 0.5}, {"", 0}}}}, {0}};
  mesh.rig.animations.push_back(
      {"laugh", {{KeyInterpolation::kLinear, 2, {0, 1}, {0, 1, 1, 0}}}, {{0, 3, ChannelPath::kWeights}}});
  mesh.material_names = {"stone"};
  mesh.materials.assign(mesh.triangles.size(), 0);
  AttributeStream& influences = stream_for(mesh.corner_attributes, kInfluences);
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    influences.values.insert(influences.values.end(), {0, 1, 0, 0, 0, 0, 0, 0, 0.75F, 0.25F, 0, 0, 0, 0, 0, 0});
  }
  for (const int target : {0, 1}) {
    for (const AttributeKind& kind : {kMorphOffsets, kMorphNormals}) {
      stream_for(mesh.corner_attributes, kind, target).values.assign(9 * mesh.triangles.size(), 0.5F);
    }
  }
  write_source_mesh(root / "source_mesh" / "moving.glb", mesh);
  write_source_mesh(root / "import" / "moving_mesh.glb", mesh);
  write_parameterization(root / "parameterization" / "moving.glb", mesh, map);
  GeometryImage image = fixtures::sphere_image(fixtures::tetrahedron(), 1);
  image.layout.bodies = {mesh.bodies.bodies, std::vector(image.layout.places.size(), 0)};
  for (GeometryLevel& level : image.levels) {
    for (std::size_t t = 0; t < level.positions.size(); ++t) {
      level.influences.insert(level.influences.end(), {1, 0, 0, 0, 0, 0, 0, 0, 0.5F, 0.5F, 0, 0, 0, 0, 0, 0});
    }
  }
  write_geometry_image(root / "geometry_image" / "moving.gim.exr", image);
}

/// The same as an asset: two parts, one of them in two places.
TestGltf asset_with_copies() {
  TestGltf gltf = tetrahedron();
  gltf.document["meshes"].push_back(gltf.document["meshes"][0]);
  gltf.add_node({{"mesh", 1}});
  gltf.add_node({{"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1}}});
  gltf.document["scenes"] = {{{"nodes", {0, 1, 2}}, {"name", "main"}}};
  gltf.document["asset"]["extras"] = {{"parts", 2}, {"copies", 1}};
  return gltf;
}

void write_corpus(const fs::path& root) {
  fuzz::write_mesh_corpus(root);
  write_gltf_files(folder_for(root, "import"));
  const auto [mesh, map] = fixtures::subdivided_sphere(fixtures::octahedron(), 2);
  write_source_mesh(folder_for(root, "source_mesh") / "sphere.glb", mesh);
  SourceMesh parted = mesh;
  parted.positions[3] = parted.positions[9] = Vec3f(parted.positions[1]);
  parted.material_names = {"stone", "cap of stone"};
  parted.cap_of = {-1, 0};
  parted.materials.assign(parted.triangles.size(), 0);
  parted.materials.back() = 1;
  write_source_mesh(root / "source_mesh" / "parted.glb", parted);
  write_source_mesh(root / "import" / "parted.glb", parted);
  write_parameterization(folder_for(root, "parameterization") / "sphere.glb", mesh, map);
  write_patch_set(folder_for(root, "patch_set") / "sphere.exr", fixtures::sphere_patches(fixtures::tetrahedron(), 1));
  const fs::path images = folder_for(root, "geometry_image");
  write_geometry_image(images / "one_level.gim.exr", fixtures::sphere_image(fixtures::tetrahedron(), 0));
  write_geometry_image(images / "levels.gim.exr", fixtures::sphere_image(fixtures::tetrahedron(), 2));
  // With marks of caps.
  PatchSet capped_patches = fixtures::sphere_patches(fixtures::tetrahedron(), 1);
  for (const Vec3f& p : capped_patches.positions) capped_patches.caps.push_back(p.z > 0 ? 1 : 0);
  write_patch_set(root / "patch_set" / "capped.exr", capped_patches);
  GeometryImage capped = fixtures::sphere_image(fixtures::tetrahedron(), 1);
  for (GeometryLevel& level : capped.levels) {
    for (const Vec3f& p : level.positions) level.caps.push_back(p.z > 0 ? 1 : 0);
  }
  write_geometry_image(images / "capped.gim.exr", capped);
  // And a surface that ends somewhere.
  const fixtures::OpenSurface open = fixtures::fan(2, 2);
  write_parameterization(folder_for(root, "parameterization") / "open.glb", open.mesh, open.map);
  write_patch_set(folder_for(root, "patch_set") / "open.exr", fixtures::open_patches(open, 1));
  write_geometry_image(images / "open.gim.exr", fixtures::open_image(open, 1));
  write_repeats(root);
  fs::create_directories(root / "asset");
  write_moving(root);
  for (const char* json : {"repeated.gim.json", "moving.gim.json", "one_level.gim.json", "levels.gim.json",
                           "capped.gim.json", "open.gim.json"}) {
    fs::remove(images / json);
  }
  const fs::path png = folder_for(root, "map_png") / "flat.png";
  write_map(png, fixtures::flat_normal_map());
  write_bytes(folder_for(root, "asset") / "textured.glb", asset_with_texture(fixtures::bytes_of(png)).glb());
  write_bytes(folder_for(root, "texture") / "flat.png", fixtures::bytes_of(png));
  fuzz::write_painted_corpus(root);
  write_bytes(root / "asset" / "copies.glb", asset_with_copies().glb());
  write_map(folder_for(root, "map_exr") / "flat.exr", fixtures::flat_normal_map(), 32);
  const BakedMap flat = fixtures::flat_normal_map();
  const GeometryImage six_patches = fixtures::sphere_image(fixtures::tetrahedron(), 1);
  write_map_mips(folder_for(root, "map_ktx2") / "flat.ktx2", flat, surface_mips(flat, six_patches.layout), 8);
}

}  // namespace
}  // namespace lozenge

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "Usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  lozenge::write_corpus(argv[1]);
}
