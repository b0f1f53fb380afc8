// What exporters do against glTF's rules, and viewers read all the same: each small case is read, a note says what
// became of it, and --strict refuses it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "formats/base/error.h"
#include "stages/import/gltf_fixtures.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using namespace testing_gltf;

struct DeviatingDocument {
  std::string what;
  std::string note;  ///< a part of what is said of it
  std::function<void(TestGltf&)> deviate;
  std::size_t triangles = 4;
};

json& accessor(TestGltf& gltf, int i) { return gltf.document["accessors"][i]; }
json& primitive(TestGltf& gltf) { return gltf.document["meshes"][0]["primitives"][0]; }
json& node(TestGltf& gltf) { return gltf.document["nodes"][0]; }

/// A second primitive, whose accessors are the caller's.
json& add_primitive(TestGltf& gltf) {
  gltf.document["meshes"][0]["primitives"].push_back(primitive(gltf));
  return gltf.document["meshes"][0]["primitives"].back();
}

const std::vector<DeviatingDocument>& deviating_documents() {
  static const std::vector<DeviatingDocument> documents{
      {"a mesh without primitives that nothing places", "mesh 1: has no primitives; left out",
       [](TestGltf& g) { g.add_mesh(json::array()); }},
      {"a mesh without primitives that a node places", "mesh 1: has no primitives; left out",
       [](TestGltf& g) {
         g.add_node({{"mesh", g.add_mesh(json::array())}});
       }},
      {"an accessor of no elements that nothing uses", "accessor 2: count is 0; left out",
       [](TestGltf& g) {
         g.add_accessor({{"componentType", kFloat}, {"type", "SCALAR"}, {"count", 0}});
       }},
      {"an accessor past its view that nothing uses", "past buffer view 0",
       [](TestGltf& g) {
         g.add_accessor({{"bufferView", 0}, {"componentType", kFloat}, {"type", "VEC3"}, {"count", 1000000}});
       }},
      {"a view past its buffer that nothing uses", "buffer view 2: ends",
       [](TestGltf& g) {
         g.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 90}, {"byteLength", 900}});
       }},
      {"corners left over", "has 11 corners, which is not a multiple of 3; read as the whole triangles",
       [](TestGltf& g) { accessor(g, 1)["count"] = 11; }, 3},
      {"an index past the vertices, beside others",
       "mesh 0 primitive 1: index 2 is 77, but there are 4 vertices; left out",
       [](TestGltf& g) {
         add_primitive(g)["indices"] = g.add_values(std::vector<std::uint32_t>{0, 1, 77}, "SCALAR", kUnsignedInt);
       }},
      {"a position that is no number, beside others",
       "the position of vertex 1 is not finite; repair the mesh; left out",
       [](TestGltf& g) {
         const std::vector<float> positions{0, 0, 0, NAN, 0, 0, 0, 1, 0};
         json& added = add_primitive(g);
         added["attributes"]["POSITION"] = g.add_values(positions, "VEC3", kFloat);
         added.erase("indices");
       }},
      {"a primitive without positions, beside others", "mesh 0 primitive 1: has no POSITION; left out",
       [](TestGltf& g) { add_primitive(g)["attributes"] = json::object(); }},
      {"a primitive of a mode that there isn't, beside others", "mesh 0 primitive 1: mode is 9",
       [](TestGltf& g) { add_primitive(g)["mode"] = 9; }},
      {"a child that is also at the top", "node 0: is in the scene twice",
       [](TestGltf& g) {
         g.add_node({{"children", {0}}, {"translation", {2, 0, 0}}});
         g.document["scenes"] = {{{"nodes", {0, 1}}}};
       }},
      {"a node twice in the scene", "node 0: is in the scene twice",
       [](TestGltf& g) {
         g.document["scenes"] = {{{"nodes", {0, 0}}}};
       }},
      {"a node below two others", "node 0: is a child of node 1 and of node 2",
       [](TestGltf& g) {
         g.add_node({{"children", {0}}});
         g.add_node({{"children", {0}}});
       }},
      {"nodes below each other", "node 1: is below itself",
       [](TestGltf& g) {
         g.add_node({{"children", {2}}});
         g.add_node({{"children", {1}}});
       }},
      {"a node that is its own child", "node 0: is below itself", [](TestGltf& g) { node(g)["children"] = {0}; }},
      {"a child that isn't there", "node 0: children names 9", [](TestGltf& g) { node(g)["children"] = {9}; }},
      {"a scene that isn't there", "scene is 1, but there are 1",
       [](TestGltf& g) {
         g.document["scenes"] = {{{"nodes", {0}}}};
         g.document["scene"] = 1;
       }},
      {"a material that isn't there", "material is 3, but there are 0",
       [](TestGltf& g) { primitive(g)["material"] = 3; }},
      {"whole numbers as fractions", "/accessors/0/count is 4.0 (and 1 more like it); read as that number",
       [](TestGltf& g) {
         accessor(g, 0)["count"] = 4.0;
         accessor(g, 1)["count"] = 12.0;
       }},
      {"a last row that is nearly right", "node 0: its matrix is not affine; read as if it were",
       [](TestGltf& g) { node(g)["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 0.9999999}; }},
      {"a matrix of 15 numbers", "node 0: matrix is not a list of 16 numbers",
       [](TestGltf& g) { node(g)["matrix"] = std::vector<double>(15, 1); }},
      {"a rotation of no length", "node 0: its rotation",
       [](TestGltf& g) {
         node(g)["rotation"] = {0, 0, 0, 0};
       }},
      {"a stride of 0", "buffer view 0: byteStride is 0",
       [](TestGltf& g) { g.document["bufferViews"][0]["byteStride"] = 0; }},
      {"a material of -1", "/meshes/0/primitives/0/material is -1", [](TestGltf& g) { primitive(g)["material"] = -1; }},
      {"a name that is null", "/materials/0/name is null",
       [](TestGltf& g) {
         g.document["materials"] = {{{"name", nullptr}}};
       }},
      {"a name that is a number", "/nodes/0/name is 7", [](TestGltf& g) { node(g)["name"] = 7; }},
      {"colours of plain integers", "COLOR_0 is of a type that glTF doesn't allow for it; the mesh is read without it",
       [](TestGltf& g) {
         primitive(g)["attributes"]["COLOR_0"] = g.add_values(std::vector<std::uint8_t>(16, 1), "VEC4", kUnsignedByte);
       }},
      {"colours of another number", "COLOR_0 has 3 elements, but there are 4 vertices; the mesh is read without it",
       [](TestGltf& g) {
         primitive(g)["attributes"]["COLOR_0"] = g.add_values(std::vector<float>(12), "VEC4", kFloat);
       }},
      {"an attribute that isn't there", "TEXCOORD_0 is 9, but there are 2; the mesh is read without it",
       [](TestGltf& g) { primitive(g)["attributes"]["TEXCOORD_0"] = 9; }},
      {"a buffer that says too much", "byteLength is 1000, but the binary chunk has 96 bytes",
       [](TestGltf& g) {
         g.document["buffers"] = {{{"byteLength", 1000}}};
       }},
      {"a further buffer without bytes", "buffer 1: has no uri",
       [](TestGltf& g) {
         g.document["buffers"] = {{{"byteLength", 96}}, {{"byteLength", 96}}};
       }},
      {"an animation without samplers", "tinygltf can't parse it",
       [](TestGltf& g) {
         g.document["animations"] = {
             {{"channels", {{{"sampler", 0}, {"target", {{"path", "scale"}}}}}}, {"samplers", {{{"input", "?"}}}}}};
       }},
  };
  return documents;
}

bool any_holds(const std::vector<std::string>& notes, const std::string& text) {
  return std::any_of(notes.begin(), notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

std::string joined(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += note + "\n";
  return text;
}

void expect_read(const std::filesystem::path& path, const std::string& note, std::size_t triangles) {
  ImportReport report;
  EXPECT_EQ(import_surface(path, {.fill_holes = 0}, {}, &report).triangles.size(), triangles);
  EXPECT_TRUE(any_holds(report.notes, note)) << joined(report.notes) << "lacks " << note;
  try {
    import_surface(path, {.fill_holes = 0, .strict = true});
    ADD_FAILURE() << "--strict takes it";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUnusableInput);
    const std::string message = error.what();
    EXPECT_NE(message.find("--strict"), std::string::npos) << message;
    EXPECT_EQ(message.find(path.filename().string()), 0U) << message;
  }
}

TEST(Deviations, AreReadWithANoteAndStrictRefusesThem) {
  const fixtures::TestFolder folder;
  for (const DeviatingDocument& document : deviating_documents()) {
    SCOPED_TRACE(document.what);
    TestGltf gltf = tetrahedron();
    document.deviate(gltf);
    write_bytes(folder / "odd.glb", gltf.glb());
    expect_read(folder / "odd.glb", document.note, document.triangles);
  }
}

TEST(Deviations, OfItsTextAreRead) {
  const fixtures::TestFolder folder;
  TestGltf gltf = tetrahedron();
  node(gltf)["name"] = "NAME";
  gltf.glb();
  const std::string text = gltf.document.dump();
  const auto named = [&](const std::string& name) {
    std::string changed = text;
    return changed.replace(changed.find("NAME"), 4, name);
  };
  const auto read = [&](const std::string& json_text, const std::string& note) {
    SCOPED_TRACE(note);
    write_bytes(folder / "odd.glb", TestGltf::pack_glb(json_text, gltf.bytes));
    expect_read(folder / "odd.glb", note, 4);
  };
  read(named("\\ud83d"), "half a surrogate pair");
  read(named("\\uDE00\\ud83d"), "half a surrogate pair");
  read(named("\\\\\\ud83d"), "half a surrogate pair");
  read(named("caf\xE9"), "no UTF-8");
  read(text + std::string(4, '\0'), "zeros follow its JSON");

  write_bytes(folder / "whole.glb", TestGltf::pack_glb(named("\\ud83d\\ude00 \\\\ud83d"), gltf.bytes));
  ImportReport report;
  EXPECT_EQ(import_surface(folder / "whole.glb", {.strict = true}, {}, &report).scene_name, "\xF0\x9F\x98\x80 \\ud83d");
}

TEST(Deviations, ThatLeaveNothingAreRefusedWithTheReason) {
  const fixtures::TestFolder folder;
  TestGltf gltf = tetrahedron();
  node(gltf)["name"] = nullptr;
  accessor(gltf, 0)["count"] = 5;
  write_bytes(folder / "bad.glb", gltf.glb());
  try {
    import_surface(folder / "bad.glb");
    ADD_FAILURE() << "was not refused";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "bad.glb: accessor 0: ends 12 bytes past buffer view 0, which has 48");
  }
}

TEST(Deviations, OfAChildAtTheTopLeaveItBelowItsParent) {
  const fixtures::TestFolder folder;
  TestGltf gltf = tetrahedron();
  gltf.add_node({{"children", {0}}, {"translation", {2, 0, 0}}});
  gltf.document["scenes"] = {{{"nodes", {0, 1}}}};
  write_bytes(folder / "odd.glb", gltf.glb());
  EXPECT_EQ(bounds_of(import_surface(folder / "odd.glb").positions).low, Vec3f(1, -1, -1));
}

}  // namespace
}  // namespace lozenge
