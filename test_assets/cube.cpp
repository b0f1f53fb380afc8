// A cube as a modelling program exports it: each face has vertices and normals of its own.

#include "test_assets/documents.h"

namespace lozenge::test_assets {
namespace {

/// Adds the face whose outer normal is x cross y. Coordinates are multiples of 2 / quads, exact where that is a power
/// of two, so that faces meet bit by bit.
void add_face(Primitive& primitive, const Vec3f& x, const Vec3f& y, int quads) {
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  const Vec3f normal = x.cross(y);
  const auto step = [=](int k) { return 2 * float(k) / float(quads) - 1; };
  for (int j = 0; j <= quads; ++j) {
    for (int i = 0; i <= quads; ++i) {
      primitive.positions.push_back(normal + x * step(i) + y * step(j));
      primitive.normals.push_back(normal);
    }
  }
  const auto row = static_cast<std::uint32_t>(quads) + 1;
  for (std::uint32_t j = 0; j + 1 < row; ++j) {
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const std::uint32_t a = first + j * row + i;
      primitive.indices.insert(primitive.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
    }
  }
}

}  // namespace

Document cube_document(int quads) {
  const Vec3f x(1, 0, 0);
  const Vec3f y(0, 1, 0);
  const Vec3f z(0, 0, 1);
  Primitive primitive;
  for (const auto& [u, v] : {std::pair(x, y), {y, z}, {z, x}, {y, x}, {z, y}, {x, z}}) add_face(primitive, u, v, quads);
  Document document;
  document.scene_name = "Cube";
  document.meshes = {{std::move(primitive)}};
  document.nodes.push_back({.name = "Cube", .mesh = 0});
  document.roots = {0};
  return document;
}

}  // namespace lozenge::test_assets
