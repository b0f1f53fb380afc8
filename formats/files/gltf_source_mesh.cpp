// A welded vertex becomes one vertex of a primitive for each set of attributes that its corners there have. Reading
// welds them again; as welding is exact, and numbers vertices by their first use, it gives the mesh that was written.
// Where vertices share a position, each carries the number of those before it at that position, and reading welds what
// agrees in both.
#include "formats/files/gltf_source_mesh.h"

#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/files/gltf_materials.h"
#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/influences.h"
#include "formats/files/readers/gltf/materials.h"
#include "formats/files/readers/gltf/primitive.h"
#include "formats/files/readers/gltf/rig.h"
#include "formats/files/rig_nodes.h"
#include "formats/files/surface_builder.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/pose.h"

namespace lozenge {

namespace {

using tinygltf::Value;

constexpr int kVersion = 1;

/// In `asset.extras.lozenge`, where the materials of the file are those of the asset; else they have but names.
constexpr const char* kLooks = "looks";

/// Corners of the triangles of one material.
struct CornerRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::vector<CornerRange> ranges_of_materials(const SourceMesh& mesh) {
  std::vector<CornerRange> ranges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool starts = t == 0 || (!mesh.materials.empty() && mesh.materials[t] != mesh.materials[t - 1]);
    if (starts) ranges.push_back({3 * t, 3 * t});
    ranges.back().end = 3 * t + 3;
  }
  return ranges;
}

/// The vertices of one primitive.
struct SplitVertices {
  std::vector<std::uint32_t> indices;  ///< [corner of the range] its vertex
  std::vector<std::size_t> corners;    ///< [vertex] the first corner that uses it
};

/// Corners become one vertex where they have the same position and the same bits in all attributes.
SplitVertices split_vertices(const SourceMesh& mesh, CornerRange range) {
  const std::size_t count = range.end - range.begin;
  std::vector<meshopt_Stream> streams;
  streams.push_back({&mesh.triangles[range.begin / 3][0], sizeof(VertexId), sizeof(VertexId)});
  for (const AttributeStream& stream : mesh.corner_attributes) {
    const std::size_t size = sizeof(float) * static_cast<std::size_t>(stream.kind.components);
    streams.push_back({stream.at(range.begin), size, size});
  }
  SplitVertices split;
  split.indices.resize(count);
  const std::size_t vertices =
      meshopt_generateVertexRemapMulti(split.indices.data(), nullptr, count, count, streams.data(), streams.size());
  split.corners.reserve(vertices);
  for (std::size_t c = 0; c < count; ++c) {
    if (split.indices[c] == split.corners.size()) split.corners.push_back(range.begin + c);
  }
  return split;
}

template <typename Vector>
std::span<const float> as_floats(const std::vector<Vector>& vectors) {
  return {&vectors.data()->x, vectors.size() * (sizeof(Vector) / sizeof(float))};
}

/// How the file calls it. glTF's own names are for directions of unit length.
std::string stored_name(const AttributeStream& stream, std::span<const float> values) {
  const bool loose = !stream.kind.loose_semantic.empty() && !all_unit(stream, values);
  return loose ? std::string(stream.kind.loose_semantic) : attribute_name(stream.kind, stream.set);
}

/// [vertex] how many vertices with a lower number have the same position; empty where none has.
/// \throws Error(kLimit) where a float can't hold that number
std::vector<float> sheets_of(const SourceMesh& mesh) {
  std::vector<unsigned int> place(mesh.positions.size());
  const std::size_t places = meshopt_generateVertexRemap(place.data(), nullptr, place.size(), mesh.positions.data(),
                                                         place.size(), sizeof(Vec3f));
  if (places == place.size()) return {};
  std::vector<std::int32_t> found(places, 0);
  std::vector<float> sheets(place.size());
  for (std::size_t v = 0; v < place.size(); ++v) {
    constexpr std::int32_t kMost = 1 << 24;
    const std::int32_t sheet = found[place[v]]++;
    if (sheet > kMost) throw Error(ExitCode::kLimit, mesh.origin + ": has more than 2^24 vertices at one position");
    sheets[v] = static_cast<float>(sheet);
  }
  return sheets;
}

/// As two accessors for each set, of joints and of weights.
void add_influences(const std::vector<float>& values, tinygltf::Primitive& primitive, GltfBuffer& buffer) {
  const auto add = [&](std::size_t first, const char* name) {
    std::vector<float> four;
    for (std::size_t i = first; i < values.size(); i += kInfluences.components) {
      four.insert(four.end(), &values[i], &values[i] + kJointsOfSet);
    }
    primitive.attributes[name] = buffer.add_floats(four, kJointsOfSet);
  };
  for (int set = 0; set < sets_of_joints(values); ++set) {
    const auto first = static_cast<std::size_t>(set * kJointsOfSet);
    add(first, kStoredJoints[static_cast<std::size_t>(set)]);
    add(kMostJoints + first, kStoredWeights[static_cast<std::size_t>(set)]);
  }
}

tinygltf::Primitive make_primitive(const SourceMesh& mesh, CornerRange range, const SplitVertices& split,
                                   const std::vector<VertexAttribute>& attributes, GltfBuffer& buffer) {
  const auto vertex_at = [&](std::size_t corner) {
    return static_cast<std::size_t>(mesh.triangles[corner / 3][corner % 3]);
  };
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  if (!mesh.materials.empty()) primitive.material = mesh.materials[range.begin / 3];
  primitive.indices = buffer.add_indices(split.indices);

  std::vector<Vec3f> positions;
  positions.reserve(split.corners.size());
  for (const std::size_t c : split.corners) positions.push_back(mesh.positions[vertex_at(c)]);
  primitive.attributes["POSITION"] = buffer.add_floats(as_floats(positions), 3, true);
  positions = {};
  for (const AttributeStream& stream : mesh.corner_attributes) {
    const std::vector<float> values = gathered(stream.values, static_cast<std::size_t>(stream.kind.components),
                                               std::span<const std::size_t>(split.corners));
    if (stream.kind == kInfluences) {
      add_influences(values, primitive, buffer);
      continue;
    }
    primitive.attributes[stored_name(stream, values)] = buffer.add_floats(values, stream.kind.components);
  }
  for (const VertexAttribute& attribute : attributes) {
    const auto n = static_cast<std::size_t>(attribute.components);
    std::vector<float> values;
    values.reserve(n * split.corners.size());
    for (const std::size_t c : split.corners) {
      const auto from = attribute.values.begin() + static_cast<std::ptrdiff_t>(n * vertex_at(c));
      values.insert(values.end(), from, from + attribute.components);
    }
    primitive.attributes[attribute.name] = buffer.add_floats(values, attribute.components);
  }
  return primitive;
}

Value stored_names(const SourceMesh& mesh, const std::string& kind) {
  return Value(Value::Object{{"file", Value(kind)},
                             {"version", Value(kVersion)},
                             {"vertices", Value(static_cast<int>(mesh.positions.size()))},
                             {"triangles", Value(static_cast<int>(mesh.triangles.size()))},
                             {"scene", Value(mesh.scene_name)},
                             {"origin", Value(mesh.origin)},
                             {"generator", Value(mesh.generator)}});
}

Value::Array list_of(const std::vector<std::int32_t>& numbers) {
  Value::Array list;
  for (const std::int32_t number : numbers) list.emplace_back(number);
  return list;
}

Value::Array list_of(const Placement& placement) {
  Value::Array numbers;
  for (const double x : placement) numbers.emplace_back(x);
  return numbers;
}

Value::Array stored_targets(const std::vector<MorphTarget>& targets) {
  Value::Array list;
  for (const MorphTarget& target : targets) {
    list.emplace_back(Value::Object{{"name", Value(target.name)}, {"weight", Value(target.weight)}});
  }
  return list;
}

Value stored_bodies(const std::vector<Body>& bodies) {
  Value::Array list;
  for (const Body& body : bodies) {
    Value::Array places;
    for (const BodyPlace& place : body.places) {
      places.emplace_back(Value::Object{{"node", Value(place.node)}, {"placement", Value(list_of(place.placement))}});
    }
    Value::Object stored{{"name", Value(body.name)}, {"places", Value(std::move(places))}, {"skin", Value(body.skin)}};
    if (!body.targets.empty()) stored["targets"] = Value(stored_targets(body.targets));
    list.emplace_back(std::move(stored));
  }
  return Value(std::move(list));
}

/// The elements of an array; none where it is something else.
const Value::Array& elements(const Value& list) {
  static const Value::Array none;
  return list.IsArray() ? list.Get<Value::Array>() : none;
}

/// What isn't as it was written becomes an empty list or not a number, which `find_defect` finds.
Placement read_placement(const Value& list) {
  Placement placement;
  placement.fill(std::nan(""));
  const Value::Array& numbers = elements(list);
  for (std::size_t i = 0; numbers.size() == placement.size() && i < numbers.size(); ++i) {
    if (numbers[i].IsNumber()) placement[i] = numbers[i].GetNumberAsDouble();
  }
  return placement;
}

/// `asset.extras.lozenge`, null where there is none.
const Value& extras_of(const GltfFile& file) {
  static const Value none;
  const Value& extras = file.model->asset.extras;
  if (!extras.Has("lozenge") || !extras.Get("lozenge").IsObject()) return none;
  return extras.Get("lozenge");
}

bool holds_whole(const Value& extras, const std::string& key, std::size_t number) {
  return extras.Has(key) && extras.Get(key).IsInt() &&
         static_cast<std::size_t>(extras.Get(key).GetNumberAsInt()) == number;
}

[[noreturn]] void broken(const GltfFile& file, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, file.name + ": " + problem);
}

void require_kind(const GltfFile& file, const std::string& kind) {
  const Value& extras = extras_of(file);
  if (!is_stored_mesh(file, kind)) broken(file, "is not a " + kind + " file of lozenge");
  if (!holds_whole(extras, "version", kVersion)) {
    throw Error(ExitCode::kUnsupported, file.name + ": is a " + kind + " file of another version than " +
                                            std::to_string(kVersion) + "; make it again with this lozenge");
  }
  if (file.model->meshes.size() != 1) broken(file, "a " + kind + " file has one mesh, this has another number");
}

void read_primitives(const GltfFile& file, SurfaceBuilder& builder, std::vector<VertexAttribute>& attributes) {
  const auto count = static_cast<int>(file.model->meshes[0].primitives.size());
  for (int p = 0; p < count; ++p) {
    if (!holds_triangles(file, 0, p)) broken(file, primitive_place(0, p) + " holds no triangles");
    for (VertexAttribute& attribute : attributes) {
      const auto values = read_custom_attribute(file, 0, p, attribute.name, attribute.components);
      attribute.values.insert(attribute.values.end(), values.begin(), values.end());
    }
    builder.add(read_primitive(file, 0, p), {}, file.name + ": " + primitive_place(0, p));
  }
}

}  // namespace

void add_source_mesh(const SourceMesh& mesh, const std::vector<VertexAttribute>& attributes, const std::string& kind,
                     tinygltf::Model& model) {
  GltfBuffer buffer(model);
  add_materials(mesh, model, buffer);
  const std::vector<CornerRange> ranges = ranges_of_materials(mesh);
  std::vector<SplitVertices> splits(ranges.size());
  std::vector<float> sheets;
  for_each_index(ranges.size() + 1, true, [&](std::size_t i) {
    if (i < ranges.size()) splits[i] = split_vertices(mesh, ranges[i]);
    else sheets = sheets_of(mesh);
  });
  std::vector<VertexAttribute> all = attributes;
  if (!sheets.empty()) all.push_back({attribute_name(kSheets, 0), 1, std::move(sheets)});
  tinygltf::Mesh& target = model.meshes.emplace_back();
  target.name = mesh.scene_name;
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    target.primitives.push_back(make_primitive(mesh, ranges[r], splits[r], all, buffer));
    splits[r] = {};
  }
  tinygltf::Node& node = model.nodes.emplace_back();
  node.mesh = 0;
  if (const Vec3d& t = mesh.translation; t != Vec3d(0, 0, 0)) node.translation = {t.x, t.y, t.z};
  tinygltf::Scene& scene = model.scenes.emplace_back();
  scene.nodes = {0};
  scene.name = mesh.scene_name;
  model.defaultScene = 0;
  Value names = stored_names(mesh, kind);
  if (!mesh.material_looks.empty()) names.Get<Value::Object>()[kLooks] = Value(true);
  if (!mesh.cap_of.empty()) names.Get<Value::Object>()["cap_of"] = Value(list_of(mesh.cap_of));
  if (!mesh.bodies.empty()) {
    names.Get<Value::Object>()["bodies"] = stored_bodies(mesh.bodies.bodies);
    names.Get<Value::Object>()["body_of"] = Value(list_of(mesh.bodies.owner));
    add_rig(mesh.rig, model, buffer);
  }
  model.asset.extras = Value(Value::Object{{"lozenge", std::move(names)}});
}

bool find_stored_names(const GltfFile& file, StoredNames& names) {
  const Value& extras = extras_of(file);
  for (const char* key : {"scene", "origin", "generator"}) {
    if (!extras.Has(key) || !extras.Get(key).IsString()) return false;
  }
  names.scene = extras.Get("scene").Get<std::string>();
  names.origin = extras.Get("origin").Get<std::string>();
  names.generator = extras.Get("generator").Get<std::string>();
  return true;
}

bool has_material_looks(const GltfFile& file) {
  const Value& extras = extras_of(file);
  const bool is_surface = extras.IsObject() && extras.Has("file");
  return !file.model->materials.empty() && (!is_surface || extras.Has(kLooks));
}

std::vector<bool> double_sided_materials(const GltfFile& file, std::size_t count) {
  std::vector<bool> double_sided(count, false);
  bool any = false;
  for (std::size_t m = 0; m < std::min(count, file.model->materials.size()); ++m) {
    double_sided[m] = file.model->materials[m].doubleSided;
    any = any || double_sided[m];
  }
  return any ? double_sided : std::vector<bool>();
}

std::vector<std::int32_t> find_stored_caps(const GltfFile& file) {
  const Value& extras = extras_of(file);
  if (!extras.Has("cap_of")) return {};
  const Value& list = extras.Get("cap_of");
  const std::size_t count = file.model->materials.size();
  if (!list.IsArray() || list.ArrayLen() != count) return {};
  std::vector<std::int32_t> cap_of(count, -1);
  for (std::size_t m = 0; m < count; ++m) {
    const Value& number = list.Get(static_cast<int>(m));
    if (!number.IsInt() || number.GetNumberAsInt() < -1 || number.GetNumberAsInt() >= static_cast<int>(m)) return {};
    cap_of[m] = number.GetNumberAsInt();
  }
  return cap_of;
}

namespace {

int whole_at(const Value& object, const std::string& key, int otherwise) {
  if (!object.Has(key)) return -1;
  return object.Get(key).IsInt() ? object.Get(key).GetNumberAsInt() : otherwise;
}

std::string text_at(const Value& object, const std::string& key) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

const Value& member(const Value& object, const std::string& key) {
  static const Value none;
  return object.Has(key) ? object.Get(key) : none;
}

/// What isn't as it was written becomes something that `find_defect` finds.
Body read_body(const Value& stored) {
  Body body{text_at(stored, "name"), {}, whole_at(stored, "skin", -2)};
  for (const Value& place : elements(member(stored, "places"))) {
    body.places.push_back({read_placement(member(place, "placement")), whole_at(place, "node", -2)});
  }
  for (const Value& target : elements(member(stored, "targets"))) {
    const Value& weight = member(target, "weight");
    body.targets.push_back({text_at(target, "name"), weight.IsNumber() ? weight.GetNumberAsDouble() : std::nan("")});
  }
  return body;
}

/// As files had them before bodies: the surface stands in the first place, `copies` are further ones.
Body read_repeated_mesh(const Value& stored) {
  Body body{text_at(stored, "name"), {{}}, -1};
  for (const Value& copy : elements(member(stored, "copies"))) body.places.push_back({read_placement(copy), -1});
  return body;
}

/// [node of the file] the morph targets of the bodies there, all of which are kept.
std::vector<MeshTargets> stored_targets(const GltfFile& file, const std::vector<Body>& bodies) {
  std::vector<MeshTargets> targets(file.model->nodes.size());
  for (const Body& body : bodies) {
    const int node = body.places.empty() ? -1 : body.places.front().node;
    if (body.targets.empty() || node < 0 || node >= static_cast<int>(targets.size()) - 1) continue;
    MeshTargets& there = targets[node + 1];
    there.in_file = static_cast<int>(body.targets.size());
    there.numbers.resize(body.targets.size());
    std::iota(there.numbers.begin(), there.numbers.end(), 0);
  }
  return targets;
}

/// The nodes that come after that of the mesh, parents before children, and all skins.
Rig read_stored_rig(const GltfFile& file, const std::vector<Body>& bodies) {
  std::vector<int> nodes;
  std::vector<int> skins;
  for (int n = 1; n < static_cast<int>(file.model->nodes.size()); ++n) nodes.push_back(n);
  for (int s = 0; s < static_cast<int>(file.model->skins.size()); ++s) {
    const std::vector<int>& joints = file.model->skins[s].joints;
    const auto is_stored = [&](int joint) { return joint > 0 && joint < static_cast<int>(file.model->nodes.size()); };
    if (!std::all_of(joints.begin(), joints.end(), is_stored)) broken(file, "a joint of its skins is no node");
    skins.push_back(s);
  }
  std::vector<std::string> notes;
  return nodes.empty() ? Rig() : read_rig(file, nodes, skins, stored_targets(file, bodies), notes);
}

}  // namespace

StoredBodies find_stored_bodies(const GltfFile& file) {
  const Value& extras = extras_of(file);
  StoredBodies stored;
  std::vector<Body>& bodies = stored.bodies.bodies;
  for (const Value& body : elements(member(extras, "bodies"))) bodies.push_back(read_body(body));
  for (const Value& mesh : elements(member(extras, "repeated"))) bodies.push_back(read_repeated_mesh(mesh));
  if (bodies.empty()) return {};
  for (const Value& owner : elements(member(extras, extras.Has("body_of") ? "body_of" : "repeated_of"))) {
    stored.bodies.owner.push_back(owner.IsInt() ? owner.GetNumberAsInt() : -2);
  }
  stored.rig = read_stored_rig(file, bodies);
  const bool is_sound = !find_defect(stored.bodies, file.model->materials.size()) && fit(stored.bodies, stored.rig);
  return is_sound ? stored : StoredBodies();
}

bool is_stored_mesh(const GltfFile& file, const std::string& kind) {
  const Value& extras = extras_of(file);
  return extras.IsObject() && extras.Has("file") && extras.Get("file").IsString() &&
         extras.Get("file").Get<std::string>() == kind;
}

StoredMesh read_stored_mesh(const GltfFile& file, const std::string& kind, std::vector<VertexAttribute> attributes) {
  require_kind(file, kind);
  for (VertexAttribute& attribute : attributes) attribute.values.clear();
  SurfaceBuilder builder;
  read_primitives(file, builder, attributes);
  std::vector<std::string> material_names;
  for (const tinygltf::Material& material : file.model->materials) material_names.push_back(material.name);
  const std::size_t materials = material_names.size();
  WeldedSurface surface = builder.finish(std::move(material_names));
  SourceMesh& mesh = surface.mesh;

  StoredNames names;
  if (!find_stored_names(file, names)) broken(file, "its asset.extras.lozenge lacks a name");
  mesh.scene_name = std::move(names.scene);
  mesh.origin = std::move(names.origin);
  mesh.generator = std::move(names.generator);
  if (!file.model->nodes.empty() && file.model->nodes.front().translation.size() == 3) {
    const std::vector<double>& t = file.model->nodes.front().translation;
    mesh.translation = {t[0], t[1], t[2]};
  }
  if (has_material_looks(file)) {
    MemoryBudget budget;
    std::vector<std::string> notes;
    Deviations none;
    none.allow_none();
    GltfMaterials read = read_materials(file, std::vector<bool>(materials, true), budget, none, notes);
    if (!notes.empty()) broken(file, notes.front());
    mesh.material_looks = std::move(read.looks);
    mesh.images = std::move(read.images);
  }
  mesh.cap_of = find_stored_caps(file);
  mesh.double_sided = double_sided_materials(file, materials);
  StoredBodies bodies = find_stored_bodies(file);
  mesh.bodies = std::move(bodies.bodies);
  mesh.rig = std::move(bodies.rig);
  if (lacks_influences(mesh)) broken(file, "a skin's vertices have no joints; make it again");
  const Value& extras = extras_of(file);
  const bool as_written =
      surface.dropped_triangles == 0 && surface.repaired_attributes == 0 && mesh.material_names.size() == materials &&
      holds_whole(extras, "vertices", mesh.positions.size()) && holds_whole(extras, "triangles", mesh.triangles.size());
  if (!as_written) broken(file, "its mesh is not the one that was written; make it again, or import it");
  return {std::move(mesh), std::move(surface.vertex_of), std::move(attributes)};
}

}  // namespace lozenge
