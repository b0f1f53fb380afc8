// The map's positions are vertex attributes of the mesh, each coordinate in two floats, which hold all of its 40 bits;
// the domain is in the extras, as lists of whole numbers.
#include "formats/files/parameterization_file.h"

#include <tiny_gltf.h>

#include <cmath>

#include "formats/base/error.h"
#include "formats/files/gltf_source_mesh.h"
#include "formats/files/gltf_writer.h"

namespace lozenge {

namespace {

using tinygltf::Value;

constexpr const char* kKind = "parameterization";
constexpr const char* kExtras = "lozenge_domain";
constexpr const char* kTriangle = "_DOMAIN_TRIANGLE";
constexpr const char* kAlphaBeta = "_DOMAIN_ALPHA_BETA";
/// Without first levels a file is one of version 1, which had none.
constexpr int kVersion = 2;
constexpr int kVersionWithoutFirstLevels = 1;

/// Whole numbers below are exact in a float.
constexpr std::int32_t kMostTriangles = 1 << 24;

[[noreturn]] void broken(const GltfFile& file, const std::string& problem) {
  throw Error(ExitCode::kUnusableInput, file.name + ": " + problem);
}

template <typename Numbers>
Value list_of(const Numbers& numbers) {
  Value::Array list;
  for (const std::int32_t number : numbers) list.emplace_back(number);
  return Value(std::move(list));
}

Value stored_domain(const Parameterization& map) {
  const Domain& domain = map.domain;
  Value::Array corners;
  Value::Array neighbours;
  for (const DomainTriangle& triangle : domain.triangles) {
    corners.push_back(list_of(triangle.corners));
    std::vector<std::int32_t> sides;
    for (const DomainSide& side : triangle.neighbours) sides.insert(sides.end(), {side.triangle, side.side});
    neighbours.push_back(list_of(sides));
  }
  Value::Object stored{{"version", Value(map.first_levels.empty() ? kVersionWithoutFirstLevels : kVersion)},
                       {"vertices", Value(domain.vertex_count)},
                       {"corners", Value(std::move(corners))},
                       {"neighbours", Value(std::move(neighbours))}};
  if (!map.first_levels.empty()) stored.emplace("first_levels", list_of(map.first_levels));
  if (map.source_triangles > 0) stored.emplace("source_triangles", Value(static_cast<int>(map.source_triangles)));
  return Value(std::move(stored));
}

/// The list of exactly `count` whole numbers from `least` up, at `place`.
std::vector<std::int32_t> read_list(const GltfFile& file, const Value& list, std::size_t count, std::int32_t least,
                                    const std::string& place) {
  if (!list.IsArray() || list.ArrayLen() != count)
    broken(file, place + " is not a list of " + std::to_string(count) + " numbers");
  std::vector<std::int32_t> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const Value& number = list.Get(static_cast<int>(i));
    if (!number.IsInt() || number.GetNumberAsInt() < least) broken(file, place + " holds something that is no index");
    numbers.push_back(number.GetNumberAsInt());
  }
  return numbers;
}

const Value& member(const GltfFile& file, const Value& object, const std::string& key) {
  if (!object.IsObject() || !object.Has(key)) broken(file, "the mesh's extras lack the domain's " + key);
  return object.Get(key);
}

DomainTriangle read_triangle(const GltfFile& file, const Value& corners, const Value& neighbours, std::size_t t) {
  const std::string place = " of domain triangle " + std::to_string(t);
  const auto ids = read_list(file, corners, 3, 0, "corners" + place);
  const auto sides = read_list(file, neighbours, 6, -1, "neighbours" + place);
  DomainTriangle triangle;
  for (int s = 0; s < 3; ++s) {
    triangle.corners[s] = ids[s];
    triangle.neighbours[s] = {sides[2 * s], sides[2 * s + 1]};
    if ((sides[2 * s] < 0) != (sides[2 * s + 1] < 0)) broken(file, "neighbours" + place + " name half a side");
  }
  return triangle;
}

/// What the extras hold of the map. \throws Error where it is of a version that this program doesn't know
const Value& stored_map(const GltfFile& file) {
  const Value& stored = member(file, file.model->meshes[0].extras, kExtras);
  const Value& version = member(file, stored, "version");
  if (!version.IsInt() || version.GetNumberAsInt() < kVersionWithoutFirstLevels ||
      version.GetNumberAsInt() > kVersion) {
    throw Error(ExitCode::kUnsupported, file.name + ": its domain is of another version than 1 to " +
                                            std::to_string(kVersion) + "; make it again with this lozenge");
  }
  return stored;
}

std::vector<std::int32_t> read_first_levels(const GltfFile& file, const Value& stored, const Domain& domain) {
  if (member(file, stored, "version").GetNumberAsInt() == kVersionWithoutFirstLevels) return {};
  std::vector<std::int32_t> levels =
      read_list(file, member(file, stored, "first_levels"), domain.triangles.size(), 0, "the list of first levels");
  if (const auto defect = find_first_level_defect(domain, levels)) broken(file, *defect);
  return levels;
}

std::int64_t read_source_triangles(const GltfFile& file, const Value& stored) {
  if (!stored.Has("source_triangles")) return 0;
  const Value& count = stored.Get("source_triangles");
  if (!count.IsInt() || count.GetNumberAsInt() < 1) broken(file, "the number of the source's triangles is none");
  return count.GetNumberAsInt();
}

Domain read_domain(const GltfFile& file, const Value& stored) {
  const Value& corners = member(file, stored, "corners");
  const Value& neighbours = member(file, stored, "neighbours");
  const Value& vertices = member(file, stored, "vertices");
  if (!corners.IsArray() || !neighbours.IsArray() || neighbours.ArrayLen() != corners.ArrayLen() ||
      corners.ArrayLen() >= static_cast<std::size_t>(kMostTriangles)) {
    broken(file, "corners and neighbours of the domain are not lists of the same, sensible length");
  }
  Domain domain;
  for (std::size_t t = 0; t < corners.ArrayLen(); ++t) {
    const int i = static_cast<int>(t);
    domain.triangles.push_back(read_triangle(file, corners.Get(i), neighbours.Get(i), t));
  }
  // A vertex takes a corner: more of them than corners can't all be used, and are not worth their memory.
  domain.vertex_count = vertices.IsInt() ? vertices.GetNumberAsInt() : -1;
  if (domain.vertex_count < 0 || static_cast<std::size_t>(domain.vertex_count) > 3 * domain.triangles.size()) {
    broken(file, "the domain's vertex count fits no domain of " + std::to_string(domain.size()) + " triangles");
  }
  if (const auto defect = find_defect(domain)) broken(file, "the domain is broken: " + *defect);
  return domain;
}

/// A multiple of 2^-40 from 0 to 1 in two floats: the nearest float has its upper 24 bits, the rest fits in another.
struct FloatPair {
  float high = 0;
  float low = 0;
};
FloatPair split(double x) {
  const auto high = static_cast<float>(x);
  return {high, static_cast<float>(x - static_cast<double>(high))};
}

std::vector<VertexAttribute> domain_attributes() { return {{kTriangle, 1, {}}, {kAlphaBeta, 4, {}}}; }

std::vector<VertexAttribute> stored_positions(const std::vector<DomainPoint>& phi) {
  std::vector<VertexAttribute> attributes = domain_attributes();
  attributes[0].values.reserve(phi.size());
  attributes[1].values.reserve(4 * phi.size());
  for (const DomainPoint& p : phi) {
    const FloatPair alpha = split(p.alpha);
    const FloatPair beta = split(p.beta);
    attributes[0].values.push_back(static_cast<float>(p.triangle));
    attributes[1].values.insert(attributes[1].values.end(), {alpha.high, beta.high, alpha.low, beta.low});
  }
  return attributes;
}

/// Whether `x` is a lattice coordinate: a multiple of 2^-40 from 0 to 1, and not -0.
bool on_lattice(double x) {
  const double steps = x * static_cast<double>(kLatticeOne);
  return x >= 0 && x <= 1 && steps == std::floor(steps) && !std::signbit(x);
}

/// The position that vertex `v` of the file holds.
DomainPoint read_position(const GltfFile& file, const Domain& domain, const StoredMesh& stored, std::size_t v) {
  const float triangle = stored.attributes[0].values[v];
  const float* pair = &stored.attributes[1].values[4 * v];
  const double alpha = static_cast<double>(pair[0]) + static_cast<double>(pair[2]);
  const double beta = static_cast<double>(pair[1]) + static_cast<double>(pair[3]);
  const std::string place = "vertex " + std::to_string(v) + " of the file";
  if (!(triangle >= 0 && triangle < static_cast<float>(domain.size())) || triangle != std::floor(triangle)) {
    broken(file, place + " lies in no triangle of the domain");
  }
  if (!on_lattice(alpha) || !on_lattice(beta) || alpha + beta > 1) {
    broken(file, place + " has barycentric coordinates that are not multiples of 2^-40 inside the triangle");
  }
  return {static_cast<DomainTriangleId>(triangle), alpha, beta};
}

std::vector<DomainPoint> read_positions(const GltfFile& file, const Domain& domain, const StoredMesh& stored) {
  std::vector<DomainPoint> phi(stored.mesh.positions.size());
  for (std::size_t v = 0; v < stored.vertex_of.size(); ++v) {
    if (stored.vertex_of[v] < 0) continue;
    const DomainPoint p = read_position(file, domain, stored, v);
    DomainPoint& known = phi[stored.vertex_of[v]];
    if (known.triangle >= 0 && !(known == p)) {
      broken(file,
             "vertex " + std::to_string(v) + " of the file is mapped elsewhere than another one at the same position");
    }
    known = p;
  }
  return phi;
}

}  // namespace

void write_parameterization(const std::filesystem::path& path, const SourceMesh& mesh, const Parameterization& map) {
  if (map.domain.size() >= kMostTriangles) {
    throw Error(ExitCode::kLimit, path.string() + ": holds domains of fewer than 2^24 triangles, this one has " +
                                      std::to_string(map.domain.size()));
  }
  tinygltf::Model model;
  add_source_mesh(mesh, stored_positions(map.phi), kKind, model);
  model.meshes[0].extras = Value(Value::Object{{kExtras, stored_domain(map)}});
  write_glb(path, model);
}

std::pair<SourceMesh, Parameterization> read_parameterization(const std::filesystem::path& path) {
  const GltfFile file = open_gltf(path);
  StoredMesh stored = read_stored_mesh(file, kKind, domain_attributes());
  Parameterization map;
  const Value& domain = stored_map(file);
  map.domain = read_domain(file, domain);
  map.first_levels = read_first_levels(file, domain, map.domain);
  map.source_triangles = read_source_triangles(file, domain);
  map.phi = read_positions(file, map.domain, stored);
  return {std::move(stored.mesh), std::move(map)};
}

}  // namespace lozenge
