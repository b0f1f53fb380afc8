// What an importer must refuse, and how: the exit code, and a message that names the file and the place.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "formats/base/error.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

/// Expects that importing the file fails with this code, and a message that holds the file's name and all of these
/// texts.
void expect_refused(const std::filesystem::path& path, ExitCode code, const std::vector<std::string>& texts,
                    const ImportOptions& options = {}) {
  try {
    import_asset(path, options);
    ADD_FAILURE() << "was not refused; expected a message about " << texts.front();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find(path.filename().string()), 0U) << message;
    for (const std::string& text : texts)
      EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks " << text;
  }
}

struct BadDocument {
  std::string what;
  ExitCode code;
  std::vector<std::string> texts;
  std::function<void(TestGltf&)> damage;
};

json& accessor(TestGltf& gltf, int i) { return gltf.document["accessors"][i]; }
json& view(TestGltf& gltf, int i) { return gltf.document["bufferViews"][i]; }
json& primitive(TestGltf& gltf) { return gltf.document["meshes"][0]["primitives"][0]; }

const std::vector<BadDocument>& bad_documents() {
  constexpr ExitCode kBroken = ExitCode::kUnusableInput;
  constexpr ExitCode kUnsupported = ExitCode::kUnsupported;
  static const std::vector<BadDocument> documents{
      {"index past the vertices",
       kBroken,
       {"mesh 0 primitive 0", "index 4 is 1234", "4 vertices"},
       [](TestGltf& g) {
         const std::uint32_t i = 1234;
         std::memcpy(g.bytes.data() + 48 + 16, &i, 4);
       }},
      {"NaN position",
       kBroken,
       {"mesh 0 primitive 0", "position of vertex 2", "not finite"},
       [](TestGltf& g) {
         const float x = std::nanf("");
         std::memcpy(g.bytes.data() + 28, &x, 4);
       }},
      {"infinite position",
       kBroken,
       {"position of vertex 0", "not finite"},
       [](TestGltf& g) {
         const float x = -INFINITY;
         std::memcpy(g.bytes.data(), &x, 4);
       }},
      {"accessor past its view",
       kBroken,
       {"accessor 0", "12 bytes past buffer view 0"},
       [](TestGltf& g) { accessor(g, 0)["count"] = 5; }},
      {"accessor offset past its view",
       kBroken,
       {"accessor 1", "2 bytes past buffer view 1"},
       [](TestGltf& g) { accessor(g, 1)["byteOffset"] = 2; }},
      {"view past its buffer",
       kBroken,
       {"buffer view 1", "past buffer 0", "has 96"},
       [](TestGltf& g) { view(g, 1)["byteLength"] = 1000; }},
      {"view offset that overflows 64 bits",
       kBroken,
       {"buffer view 1", "byteOffset"},
       [](TestGltf& g) { view(g, 1)["byteOffset"] = 18446744073709551600ULL; }},
      {"count that overflows 64 bits",
       kBroken,
       {"accessor 0", "count"},
       [](TestGltf& g) { accessor(g, 0)["count"] = 18446744073709551615ULL; }},
      {"absurd count",
       kBroken,
       {"accessor 0", "bytes past"},
       [](TestGltf& g) { accessor(g, 0)["count"] = 1000000000000ULL; }},
      {"absurd count without data",
       ExitCode::kLimit,
       {"accessor 0", "no buffer view", "1000000000"},
       [](TestGltf& g) {
         accessor(g, 0).erase("bufferView");
         accessor(g, 0)["count"] = 1000000000;
       }},
      {"negative count", kBroken, {"accessor 0", "count"}, [](TestGltf& g) { accessor(g, 0)["count"] = -3; }},
      {"fractional count", kBroken, {"accessor 0", "count"}, [](TestGltf& g) { accessor(g, 0)["count"] = 3.5; }},
      {"no count", kBroken, {"accessor 0", "count is missing"}, [](TestGltf& g) { accessor(g, 0).erase("count"); }},
      {"unknown component type",
       kBroken,
       {"accessor 0", "componentType 5124"},
       [](TestGltf& g) { accessor(g, 0)["componentType"] = 5124; }},
      {"unknown type", kBroken, {"accessor 0", "VEC5"}, [](TestGltf& g) { accessor(g, 0)["type"] = "VEC5"; }},
      {"positions of two components",
       kBroken,
       {"mesh 0 primitive 0", "POSITION", "type"},
       [](TestGltf& g) { accessor(g, 0)["type"] = "VEC2"; }},
      {"positions of integers",
       kBroken,
       {"mesh 0 primitive 0", "POSITION", "type"},
       [](TestGltf& g) { accessor(g, 0)["componentType"] = kUnsignedShort; }},
      {"indices of floats",
       kBroken,
       {"accessor 1", "unsigned integers", "mesh 0 primitive 0"},
       [](TestGltf& g) { accessor(g, 1)["componentType"] = kFloat; }},
      {"no POSITION",
       kBroken,
       {"mesh 0 primitive 0", "no POSITION"},
       [](TestGltf& g) {
         primitive(g)["attributes"] = {{"NORMAL", 0}};
       }},
      {"attribute without accessor",
       kBroken,
       {"mesh 0 primitive 0", "POSITION is 9"},
       [](TestGltf& g) { primitive(g)["attributes"]["POSITION"] = 9; }},
      {"indices without accessor",
       kBroken,
       {"mesh 0 primitive 0", "indices is 9"},
       [](TestGltf& g) { primitive(g)["indices"] = 9; }},
      {"unknown mode", kBroken, {"mesh 0 primitive 0", "mode"}, [](TestGltf& g) { primitive(g)["mode"] = 7; }},
      {"view of no buffer", kBroken, {"buffer view 0", "buffer is 3"}, [](TestGltf& g) { view(g, 0)["buffer"] = 3; }},
      {"stride that isn't a multiple of 4",
       kBroken,
       {"buffer view 0", "byteStride is 13"},
       [](TestGltf& g) { view(g, 0)["byteStride"] = 13; }},
      {"elements that overlap", kBroken, {"accessor 0", "overlap"}, [](TestGltf& g) { view(g, 0)["byteStride"] = 8; }},
      {"node of no mesh", kBroken, {"node 0", "mesh is 5"}, [](TestGltf& g) { g.document["nodes"][0]["mesh"] = 5; }},
      {"transform out of range",
       kBroken,
       {"node 0", "mesh 0 primitive 0", "out of the range of floats"},
       [](TestGltf& g) {
         g.document["nodes"][0]["scale"] = {1e300, 1, 1};
       }},
      {"no triangles", kBroken, {"no triangles"}, [](TestGltf& g) { primitive(g)["mode"] = 1; }},
      {"no nodes", kBroken, {"no triangles"}, [](TestGltf& g) { g.document.erase("nodes"); }},
      {"all corners in one place",
       kBroken,
       {"4 triangles", "coinciding"},
       [](TestGltf& g) {
         g.document["nodes"][0]["scale"] = {0, 0, 0};
       }},
      {"sparse index past the end",
       kBroken,
       {"accessor 0", "sparse index 1 is 9"},
       [](TestGltf& g) {
         const int indices = g.add_view(std::vector<std::uint16_t>{0, 9});
         accessor(g, 0)["sparse"] = {{"count", 2},
                                     {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                                     {"values", {{"bufferView", 0}}}};
       }},
      {"more sparse values than elements",
       kBroken,
       {"accessor 0, sparse", "count is 5"},
       [](TestGltf& g) {
         accessor(g, 0)["sparse"] = {{"count", 5}};
       }},
      {"sparse values past their view",
       kBroken,
       {"accessor 0, sparse, values", "past buffer view"},
       [](TestGltf& g) {
         const int indices = g.add_view(std::vector<std::uint16_t>{0, 1});
         accessor(g, 0)["sparse"] = {{"count", 2},
                                     {"indices", {{"bufferView", indices}, {"componentType", kUnsignedShort}}},
                                     {"values", {{"bufferView", 0}, {"byteOffset", 30}}}};
       }},
      {"list that is no list", kBroken, {"accessors", "not a list"}, [](TestGltf& g) { g.document["accessors"] = 7; }},
      {"object that is no object",
       kBroken,
       {"mesh 0", "not a JSON object"},
       [](TestGltf& g) { g.document["meshes"] = {1}; }},
      {"no asset", kBroken, {"is not glTF"}, [](TestGltf& g) { g.document.erase("asset"); }},
      {"glTF 1.0", kUnsupported, {"version \"1.0\""}, [](TestGltf& g) { g.document["asset"]["version"] = "1.0"; }},
      {"glTF 2.1 at least", kUnsupported, {"2.1"}, [](TestGltf& g) { g.document["asset"]["minVersion"] = "2.1"; }},
      {"unknown required extension",
       kUnsupported,
       {"requires", "ACME_teapots"},
       [](TestGltf& g) { g.document["extensionsRequired"] = {"ACME_teapots"}; }},
      {"deep nesting",
       kBroken,
       {"nested deeper"},
       [](TestGltf& g) {
         json deep = 1;
         for (int i = 0; i < 1000; ++i) deep = json::array({deep});
         g.document["extras"] = deep;
       }},
  };
  return documents;
}

TEST(BadInput, IsRefusedWithTheRightCodeAndAMessageThatNamesThePlace) {
  const TestFolder folder;
  for (const BadDocument& bad : bad_documents()) {
    SCOPED_TRACE(bad.what);
    TestGltf gltf = tetrahedron();
    bad.damage(gltf);
    write_bytes(folder / "bad.glb", gltf.glb());
    expect_refused(folder / "bad.glb", bad.code, bad.texts);
  }
}

TEST(BadInput, DamagedContainersAreRefused) {
  const TestFolder folder;
  const std::string good = tetrahedron().glb();
  const auto refuse = [&](const std::string& bytes, ExitCode code, const std::vector<std::string>& texts) {
    write_bytes(folder / "bad.glb", bytes);
    expect_refused(folder / "bad.glb", code, texts);
  };
  refuse("", ExitCode::kUnusableInput, {"empty"});
  refuse("gl", ExitCode::kUnusableInput, {"too short"});
  refuse("glTF", ExitCode::kUnusableInput, {"truncated"});
  refuse("GLTF" + good.substr(4), ExitCode::kUnusableInput, {"neither GLB"});
  refuse("a file of words", ExitCode::kUnusableInput, {"neither GLB"});
  refuse("{ \"asset\": ", ExitCode::kUnusableInput, {"JSON is broken"});
  refuse("glTF" + word(1) + good.substr(8), ExitCode::kUnsupported, {"version 1"});
  refuse("glTF" + word(3) + good.substr(8), ExitCode::kUnsupported, {"version 3"});
  refuse("glTF" + word(2) + word(10) + good.substr(12), ExitCode::kUnusableInput, {"length of 10"});
  refuse(good.substr(0, 12) + word(0xFFFFFFF0) + good.substr(16), ExitCode::kUnusableInput, {"chunk of 4294967280"});
  refuse(good.substr(0, 16) + "NOSJ" + good.substr(20), ExitCode::kUnusableInput, {"not JSON"});
  std::string text(good);
  text[20] = '[';
  refuse(text, ExitCode::kUnusableInput, {"JSON"});
  refuse("[1, 2]", ExitCode::kUnusableInput, {"neither GLB"});
}

TEST(BadInput, EveryTruncationIsRefused) {
  const TestFolder folder;
  const std::string good = tetrahedron().glb();
  for (std::size_t length = 4; length < good.size(); ++length) {
    write_bytes(folder / "cut.glb", good.substr(0, length));
    expect_refused(folder / "cut.glb", ExitCode::kUnusableInput, {"truncated"});
  }
}

TEST(BadInput, MissingFilesAndBuffersAreNamed) {
  const TestFolder folder;
  expect_refused(folder / "nowhere.glb", ExitCode::kUnusableInput, {"no such file"});
  std::filesystem::create_directories(folder / "folder.glb");
  expect_refused(folder / "folder.glb", ExitCode::kUnusableInput, {"not a file"});

  TestGltf gltf = tetrahedron();
  write_bytes(folder / "a.gltf", gltf.gltf("missing.bin"));
  expect_refused(folder / "a.gltf", ExitCode::kUnusableInput, {"buffer 0", "missing.bin", "no such file"});
  write_bytes(folder / "short.bin", gltf.bytes.substr(0, 90));
  write_bytes(folder / "b.gltf", gltf.gltf("short.bin"));
  expect_refused(folder / "b.gltf", ExitCode::kUnusableInput, {"buffer 0", "short.bin", "90 bytes", "96"});
  write_bytes(folder / "c.gltf", gltf.gltf("data:application/octet-stream;base64,AAAA"));
  expect_refused(folder / "c.gltf", ExitCode::kUnusableInput, {"buffer 0", "3 bytes", "96"});
  write_bytes(folder / "d.gltf", gltf.gltf("data:text/plain,hello"));
  expect_refused(folder / "d.gltf", ExitCode::kUnusableInput, {"buffer 0", "base64"});
  gltf.document["buffers"] = {{{"byteLength", gltf.bytes.size()}}};
  write_bytes(folder / "e.gltf", gltf.document.dump());
  expect_refused(folder / "e.gltf", ExitCode::kUnusableInput, {"buffer 0", "no uri", "no binary chunk"});
}

TEST(BadInput, UrisThatLeaveTheAssetsFolderAreRefused) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  std::filesystem::create_directories(folder / "inside");
  write_bytes(folder / "outside.bin", gltf.bytes);
  const std::string absolute = (folder / "outside.bin").string();
  for (const std::string& uri :
       {std::string("../outside.bin"), std::string("below/../../outside.bin"), std::string("%2e%2e/outside.bin"),
        std::string("..%2Foutside.bin"), std::string("..\\outside.bin"), absolute, "file://" + absolute,
        std::string("http://example.com/outside.bin"), std::string("C:/outside.bin"), std::string(""),
        std::string("a%00b")}) {
    SCOPED_TRACE(uri);
    write_bytes(folder / "inside/asset.gltf", gltf.gltf(uri));
    expect_refused(folder / "inside/asset.gltf", ExitCode::kUnusableInput, {"buffer 0", "folder"});
  }
}

TEST(BadInput, LinksThatLeaveTheAssetsFolderAreRefusedOthersFollowed) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  std::filesystem::create_directories(folder / "inside/below");
  write_bytes(folder / "outside.bin", gltf.bytes);
  write_bytes(folder / "inside/real.bin", gltf.bytes);
  std::filesystem::create_symlink("../outside.bin", folder / "inside/away.bin");
  std::filesystem::create_symlink(folder.path(), folder / "inside/up");
  std::filesystem::create_symlink("../real.bin", folder / "inside/below/here.bin");
  for (const char* uri : {"away.bin", "up/outside.bin", "below/../away.bin", "%61way.bin"}) {
    SCOPED_TRACE(uri);
    write_bytes(folder / "inside/asset.gltf", gltf.gltf(uri));
    expect_refused(folder / "inside/asset.gltf", ExitCode::kUnusableInput, {"buffer 0", "folder"});
  }
  for (const char* uri : {"below/here.bin", "real.bin"}) {
    write_bytes(folder / "inside/asset.gltf", gltf.gltf(uri));
    EXPECT_EQ(import_asset(folder / "inside/asset.gltf").triangles.size(), 4U);
  }
  std::filesystem::create_directory_symlink(folder / "inside", folder / "elsewhere");
  EXPECT_EQ(import_asset(folder / "elsewhere/asset.gltf").triangles.size(), 4U) << "the folder itself may be a link";
}

TEST(BadInput, WhatTakesMoreMemoryThanAllowedIsRefusedBeforeItIsTaken) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  write_bytes(folder / "a.glb", gltf.glb());
  EXPECT_EQ(import_asset(folder / "a.glb", {.max_memory = 100'000}).triangles.size(), 4U);
  expect_refused(folder / "a.glb", ExitCode::kLimit, {"JSON", "limit is 1 kB", "--max-memory"}, {.max_memory = 1000});
  const std::size_t json_size = gltf.document.dump().size();
  expect_refused(folder / "a.glb", ExitCode::kLimit, {"binary chunk", "--max-memory"},
                 {.max_memory = 12 * (json_size + 4)});
  for (int i = 0; i < 9999; ++i) gltf.document["nodes"].push_back({{"mesh", 0}});
  write_bytes(folder / "crowd.glb", gltf.glb());
  expect_refused(folder / "crowd.glb", ExitCode::kLimit, {"40000 triangles", "limit is 8 MB"},
                 {.max_memory = 8'000'000});
  // 1 GB that a data URI of some bytes is said to hold.
  gltf.document["buffers"] = {{{"byteLength", 1'000'000'000}, {"uri", "data:;base64,AAAA"}}};
  write_bytes(folder / "lie.gltf", gltf.document.dump());
  expect_refused(folder / "lie.gltf", ExitCode::kLimit, {"buffer 0", "1.0 GB"}, {.max_memory = 100'000'000});
}

TEST(BadInput, AssetsOfMoreTrianglesThanAllowedAreRefusedBeforeTheyAreRead) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  for (int i = 0; i < 99; ++i) gltf.add_node({{"mesh", 0}, {"translation", {3 * i, 0, 0}}});
  write_bytes(folder / "crowd.glb", gltf.glb());
  EXPECT_EQ(import_asset(folder / "crowd.glb", {.max_triangles = 400}).triangles.size(), 12U)
      << "the first, and touching";
  expect_refused(folder / "crowd.glb", ExitCode::kLimit, {"399 triangles"}, {.max_triangles = 399});
}

TEST(BadInput, AChainOfManyNodesIsNoDangerToTheStack) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  for (int i = 0; i < 100000; ++i) gltf.document["nodes"].push_back({{"children", {i}}});
  write_bytes(folder / "deep.glb", gltf.glb());
  EXPECT_EQ(import_asset(folder / "deep.glb").triangles.size(), 4U);
}

/// Whatever is in the file, the importer gives a mesh or refuses with one of its own errors.
void expect_no_harm(const std::filesystem::path& path) {
  try {
    const SourceMesh mesh = import_asset(path, {.max_triangles = 100000});
    for (const auto& triangle : mesh.triangles) {
      for (const VertexId v : triangle) ASSERT_LT(static_cast<std::size_t>(v), mesh.positions.size());
    }
  } catch (const Error& error) {
    EXPECT_NE(error.code(), ExitCode::kInternal) << error.what();
  }
}

TEST(BadInput, RandomDamageToBytesIsHarmless) {
  const TestFolder folder;
  TestGltf gltf = tetrahedron();
  primitive(gltf)["attributes"]["TEXCOORD_0"] = gltf.add_values(std::vector<float>(8, 0.5F), "VEC2", kFloat);
  gltf.document["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
  const std::string good = gltf.glb();
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    std::string bad = good;
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < changes; ++k) bad[random() % bad.size()] = static_cast<char>(random() % 256);
    write_bytes(folder / "damaged.glb", bad);
    expect_no_harm(folder / "damaged.glb");
  }
}

/// All values of a document, at any depth.
void collect(json& value, std::vector<json*>& found) {
  found.push_back(&value);
  if (value.is_structured()) {
    for (json& child : value) collect(child, found);
  }
}

TEST(BadInput, RandomValuesInTheDocumentAreHarmless) {
  const TestFolder folder;
  std::mt19937 random(2);
  const std::vector<json> values{0,
                                 1,
                                 2,
                                 -1,
                                 3.5,
                                 1e300,
                                 2147483647,
                                 2147483648U,
                                 4294967295U,
                                 18446744073709551615ULL,
                                 true,
                                 "",
                                 "VEC3",
                                 "../x",
                                 nullptr,
                                 json::array(),
                                 json::object(),
                                 {0, 1, 2},
                                 {{"a", 1}},
                                 -9223372036854775807LL,
                                 5126,
                                 5123,
                                 5121,
                                 1e-320,
                                 "data:image/png;base64,",
                                 "\xC3\xA9"};
  for (int i = 0; i < 3000; ++i) {
    TestGltf gltf = tetrahedron();
    gltf.document["images"] = {{{"bufferView", 0}, {"mimeType", "image/png"}}};
    gltf.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    gltf.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
    gltf.document["samplers"] = {{{"magFilter", 9729}}};
    gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    gltf.document["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "scale"}}}}}},
                                    {"samplers", {{{"input", 0}, {"output", 0}}}}}};
    gltf.document["skins"] = {{{"joints", {0}}}};
    gltf.document["scenes"] = {{{"nodes", {0}}}};
    gltf.document["extensions"] = {
        {"KHR_lights_punctual", {{"lights", {{{"type", "spot"}, {"spot", json::object()}}}}}}};
    gltf.glb();  // adds the buffer
    std::vector<json*> places;
    collect(gltf.document, places);
    const int changes = 1 + static_cast<int>(random() % 2);
    json* first = places[1 + random() % (places.size() - 1)];
    *first = values[random() % values.size()];
    if (changes == 2) {
      places.clear();
      collect(gltf.document, places);
      *places[1 + random() % (places.size() - 1)] = values[random() % values.size()];
    }
    write_bytes(folder / "odd.glb", TestGltf::pack_glb(gltf.document.dump(), gltf.bytes));
    expect_no_harm(folder / "odd.glb");
  }
}

}  // namespace
}  // namespace lozenge
