#include "test_assets/documents.h"

#include <cmath>
#include <numbers>

namespace lozenge::test_assets {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// The nearest multiple of 2^-12: short enough that scaling by two and moving by quarters is exact.
float short_fraction(double x) { return static_cast<float>(std::round(x * 4096) / 4096); }

/// A strip of quads with columns + 1 by rows + 1 vertices of its own, texture coordinates over the unit square.
struct Sheet {
  Primitive primitive;
  int columns = 0;

  std::uint32_t at(int column, int row) const { return static_cast<std::uint32_t>(row * (columns + 1) + column); }
  void quad(int column, int row) {
    const std::uint32_t a = at(column, row);
    const std::uint32_t b = at(column + 1, row);
    const std::uint32_t c = at(column + 1, row + 1);
    const std::uint32_t d = at(column, row + 1);
    primitive.indices.insert(primitive.indices.end(), {a, b, d, b, c, d});
  }
};

/// The half x >= 0 of a ring around the z axis, over the rows [first, last) of `all` around the tube. The angles around
/// the tube are taken modulo the whole, so that both sides of a seam are computed from the same numbers.
Primitive half_ring(int first, int last, int all, int columns, std::int32_t material) {
  Sheet sheet;
  sheet.columns = columns;
  for (int row = first; row <= last; ++row) {
    const double v = kTurn * (row % all) / all;
    for (int column = 0; column <= columns; ++column) {
      const double u = kTurn * (double(column) / columns - 0.5) / 2;
      const bool on_cut = column == 0 || column == columns;
      const Vec3d outwards(on_cut ? 0.0 : std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
      const double out = 1 + 0.375 * std::cos(v);
      sheet.primitive.positions.emplace_back(on_cut ? 0.0F : short_fraction(out * std::cos(u)),
                                             short_fraction(out * std::sin(u)), short_fraction(0.375 * std::sin(v)));
      sheet.primitive.normals.emplace_back(outwards);
      sheet.primitive.uvs.emplace_back(float(column) / float(columns), float(row - first) / float(last - first));
    }
  }
  for (int row = 0; row < last - first; ++row) {
    for (int column = 0; column < columns; ++column) sheet.quad(column, row);
  }
  sheet.primitive.material = material;
  return sheet.primitive;
}

}  // namespace

Primitive globe(int columns, int rows, std::int32_t material) {
  Sheet sheet;
  sheet.columns = columns;
  for (int row = 0; row <= rows; ++row) {
    const bool pole = row == 0 || row == rows;
    const double latitude = kTurn * (double(row) / rows - 0.5) / 2;
    for (int column = 0; column <= columns; ++column) {
      const double longitude = kTurn * (column % columns) / columns;
      const double out = pole ? 0.0 : std::cos(latitude);
      sheet.primitive.positions.emplace_back(Vec3d(
          out * std::sin(longitude), pole ? (row == 0 ? -1.0 : 1.0) : std::sin(latitude), out * std::cos(longitude)));
      sheet.primitive.uvs.emplace_back(float(column) / float(columns), 1 - float(row) / float(rows));
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = sheet.at(column, row);
      const std::uint32_t b = sheet.at(column + 1, row);
      const std::uint32_t c = sheet.at(column + 1, row + 1);
      const std::uint32_t d = sheet.at(column, row + 1);
      if (row > 0) sheet.primitive.indices.insert(sheet.primitive.indices.end(), {a, b, d});
      if (row + 1 < rows) sheet.primitive.indices.insert(sheet.primitive.indices.end(), {b, c, d});
    }
  }
  sheet.primitive.material = material;
  return sheet.primitive;
}

Primitive primitive_of(const Shape& shape, bool normals) {
  Primitive primitive;
  primitive.positions = shape.positions;
  if (normals) primitive.normals = smooth_normals(shape);
  for (const auto& triangle : shape.triangles) {
    primitive.indices.insert(primitive.indices.end(), triangle.begin(), triangle.end());
  }
  return primitive;
}

Document simple_document(const std::string& name, const Shape& shape, bool normals) {
  Document document;
  document.scene_name = name;
  document.meshes = {{primitive_of(shape, normals)}};
  document.nodes.push_back({.name = name, .mesh = 0});
  document.roots = {0};
  return document;
}

Document far_document() {
  Document document = simple_document("Survey", icosphere(3), false);
  document.nodes[0].translation = {449123.37, 121.5, -5410987.62};
  return document;
}

Document two_components_document() {
  Document document;
  document.scene_name = "Ring and ball";
  document.meshes = {{primitive_of(torus(1, 0.3, 80, 32), true)}, {primitive_of(icosphere(3), true)}};
  document.nodes.push_back({.name = "Ring", .mesh = 0});
  document.nodes.push_back({.name = "Ball", .mesh = 1, .translation = {0.05, 0, 0.1}, .scale = {0.5, 0.5, 0.5}});
  document.roots = {0, 1};
  return document;
}

Document rings_document() {
  Document document;
  document.scene_name = "Rings around a ball";
  document.materials = {{"gold", {0.8, 0.6, 0.2, 1}}};
  document.meshes = {{primitive_of(icosphere(3), true)}, {primitive_of(torus(1, 0.4, 48, 20), true)}};
  document.meshes[1][0].material = 0;
  const double half = std::sqrt(0.5);
  document.nodes = {{.name = "Ball", .mesh = 0},
                    {.name = "Ring", .mesh = 1, .translation = {4, 0, 0}},
                    {.name = "Moved", .mesh = 1, .translation = {-4, 0, 0}},
                    {.name = "Turned", .mesh = 1, .translation = {0, 4, 0}, .rotation = {half, 0, 0, half}},
                    {.name = "Grown", .mesh = 1, .translation = {0, -4, 0}, .scale = {0.5, 1, 1.5}},
                    {.name = "Mirrored", .mesh = 1, .translation = {0, 0, 4}, .scale = {1, 1, -0.75}},
                    {.name = "Stretched", .children = {7}, .translation = {0, 0, -4}, .scale = {1, 1, 0.5}},
                    {.name = "Leaning", .mesh = 1, .rotation = {0.6, 0, 0, 0.8}}};
  document.roots = {0, 1, 2, 3, 4, 5, 6};
  return document;
}

Document seams_document() {
  constexpr int kAround = 32;
  constexpr int kAlong = 24;
  Document document;
  document.scene_name = "Seams";
  document.materials = {
      {"bronze", {0.6, 0.4, 0.2, 1}}, {"glaze", {0.1, 0.3, 0.5, 1}, true}, {"stone", {0.5, 0.5, 0.5, 1}}};
  document.meshes = {{half_ring(0, 12, kAround, kAlong, 0), half_ring(12, kAround, kAround, kAlong, 1)},
                     {globe(32, 16, 2)}};
  // Half a turn around y, as a quaternion without a rounded number.
  document.nodes.push_back({.name = "Ring",
                            .children = {1, 2},
                            .translation = {0.5, 1.25, -0.25},
                            .rotation = {0, 1, 0, 0},
                            .scale = {2, 2, 2}});
  document.nodes.push_back({.name = "Right half", .mesh = 0});
  document.nodes.push_back({.name = "Left half, the mirror image", .mesh = 0, .scale = {-1, 1, 1}});
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  document.nodes.push_back(
      {.name = "Ball",
       .mesh = 1,
       .matrix = {0.75 * c, 0.75 * s, 0, 0, -0.5 * s, 0.5 * c, 0, 0, 0, 0, 0.625, 0, 0.5, 1.25, -0.25, 1}});
  document.roots = {0, 3};
  return document;
}

}  // namespace lozenge::test_assets
