// Files that must be repaired or refused. Each starts from a sound document, of which one thing is broken.

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "test_assets/documents.h"

namespace lozenge::test_assets {
namespace {

using nlohmann::json;

constexpr double kTurn = 2 * std::numbers::pi;

Encoded sound() { return encode(simple_document("Sphere", icosphere(3), false)); }

/// The JSON of `encoded` after `change`.
template <typename Change>
Encoded changed(Encoded encoded, Change change) {
  json root = json::parse(encoded.json);
  change(root, encoded.binary);
  encoded.json = root.dump();
  return encoded;
}

/// A sheet of nu x nv quads over u, v in [0, 1] whose last column is glued to its first, turned over.
Shape twisted(int nu, int nv, bool close_v, const std::function<Vec3d(double, double)>& place) {
  Shape shape;
  const int rows = close_v ? nv : nv + 1;
  for (int u = 0; u < nu; ++u) {
    for (int v = 0; v < rows; ++v) shape.positions.emplace_back(place(double(u) / nu, double(v) / nv));
  }
  const auto at = [&](int u, int v) {
    if (u == nu) return close_v ? (nv - v % nv) % nv : nv - v;
    return u * rows + v % rows;
  };
  for (int u = 0; u < nu; ++u) {
    for (int v = 0; v < nv; ++v) {
      shape.triangles.push_back({at(u, v), at(u + 1, v), at(u, v + 1)});
      shape.triangles.push_back({at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
    }
  }
  return shape;
}

Shape moebius_strip() {
  return twisted(64, 8, false, [](double u, double v) {
    const double across = 0.6 * (v - 0.5);
    const double out = 1 + across * std::cos(kTurn * u / 2);
    return Vec3d(out * std::cos(kTurn * u), out * std::sin(kTurn * u), across * std::sin(kTurn * u / 2));
  });
}

/// A figure eight swept around with half a twist. It passes through itself in space, as it must; lifting the two rows
/// that would coincide at the crossing keeps all positions apart.
Shape klein_bottle() {
  return twisted(64, 24, true, [](double u, double v) {
    const double around = kTurn * v;
    const double half = kTurn * u / 2;
    const double out = 2 + std::cos(half) * std::sin(around) - std::sin(half) * std::sin(2 * around);
    const double up = std::sin(half) * std::sin(around) + std::cos(half) * std::sin(2 * around);
    const double lift = 0.1 * std::cos(around);
    return Vec3d((out + lift * std::sin(half)) * std::cos(kTurn * u),
                 (out + lift * std::sin(half)) * std::sin(kTurn * u), up + lift * std::cos(half));
  });
}

Shape open_surface() {
  Shape shape = icosphere(3);
  shape.triangles.erase(shape.triangles.begin() + 500);
  return shape;
}

/// Two tetrahedra with a wall between them: three triangles meet at each of the wall's edges.
Shape three_triangles_on_an_edge() {
  Shape shape;
  shape.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  shape.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  return shape;
}

Shape pinched_vertex() {
  Shape shape;
  shape.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  shape.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {5, 6, 0}};
  return shape;
}

/// Two balls side by side; the welded vertex at (1, 0, 0) is all that they share.
Shape touching_spheres() {
  Shape shape = octasphere(3);
  const auto count = static_cast<std::int32_t>(shape.positions.size());
  for (std::int32_t v = 0; v < count; ++v) shape.positions.push_back(shape.positions[v] + Vec3f(2, 0, 0));
  const std::vector<std::array<std::int32_t, 3>> triangles = shape.triangles;
  for (const auto& [a, b, c] : triangles) shape.triangles.push_back({a + count, b + count, c + count});
  return shape;
}

Shape flat_triangles() {
  Shape shape = icosphere(1);
  for (auto& triangle : shape.triangles) triangle[2] = triangle[0];
  return shape;
}

/// Overwrites the float at this place of the first accessor's data.
Encoded with_float(Encoded encoded, std::size_t index, float value) {
  std::memcpy(encoded.binary.data() + index * sizeof(float), &value, sizeof(float));
  return encoded;
}

void write_shapes(const std::filesystem::path& folder) {
  write_glb(folder / "open_surface.glb", simple_document("Open", open_surface(), false));
  write_glb(folder / "moebius_strip.glb", simple_document("Strip", moebius_strip(), false));
  write_glb(folder / "klein_bottle.glb", simple_document("Bottle", klein_bottle(), false));
  write_glb(folder / "three_triangles_on_an_edge.glb", simple_document("Wings", three_triangles_on_an_edge(), false));
  write_glb(folder / "pinched_vertex.glb", simple_document("Hourglass", pinched_vertex(), false));
  write_glb(folder / "touching_spheres.glb", simple_document("Touching", touching_spheres(), false));
  write_glb(folder / "flat_triangles.glb", simple_document("Flat", flat_triangles(), false));
}

void write_without_triangles(const std::filesystem::path& folder) {
  const Encoded points = changed(sound(), [](json& root, auto&) {
    root["meshes"][0]["primitives"][0]["mode"] = 0;
    root["meshes"][0]["primitives"][0].erase("indices");
  });
  write_bytes(folder / "no_triangles.glb", glb_bytes(points));
  Document empty;
  empty.scene_name = "Empty";
  empty.nodes.push_back({.name = "Nothing"});
  empty.roots = {0};
  write_glb(folder / "no_meshes.glb", empty);
}

void write_broken_containers(const std::filesystem::path& folder) {
  std::vector<std::uint8_t> bytes = glb_bytes(sound());
  write_bytes(folder / "truncated.glb", {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2)});
  write_bytes(folder / "empty.glb", {});
  bytes[0] = 'b';
  write_bytes(folder / "wrong_magic.glb", bytes);
  const std::string text = sound().json;
  write_text(folder / "broken_json.gltf", text.substr(0, text.size() / 2));
}

void write_broken_data(const std::filesystem::path& folder) {
  const Encoded past_buffer = changed(sound(), [](json& root, auto&) { root["accessors"][0]["count"] = 1000000; });
  write_bytes(folder / "accessor_past_its_buffer.glb", glb_bytes(past_buffer));
  const Encoded past_vertices = changed(sound(), [](json& root, std::vector<std::uint8_t>& binary) {
    const std::size_t indices = root["bufferViews"][1]["byteOffset"];
    const std::uint16_t count = root["accessors"][0]["count"];
    std::memcpy(binary.data() + indices + 30, &count, sizeof(count));
  });
  write_bytes(folder / "index_past_its_vertices.glb", glb_bytes(past_vertices));
  write_bytes(folder / "nan_position.glb",
              glb_bytes(with_float(sound(), 301, std::numeric_limits<float>::quiet_NaN())));
  write_bytes(folder / "infinite_position.glb",
              glb_bytes(with_float(sound(), 301, std::numeric_limits<float>::infinity())));
  write_text(folder / "missing_buffer.gltf",
             encode(simple_document("Sphere", icosphere(3), false), "this_file_is_missing.bin").json);
}

}  // namespace

void write_bad_assets(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "bad");
  write_shapes(folder / "bad");
  write_without_triangles(folder / "bad");
  write_broken_containers(folder / "bad");
  write_broken_data(folder / "bad");
}

}  // namespace lozenge::test_assets
