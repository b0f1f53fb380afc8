// STL: triangles without anything shared between them, as text or as bytes. What is in the file's first line, and the
// normals, are left out.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "formats/base/error.h"
#include "tools/bench/mesh_formats.h"
#include "tools/bench/text_scanner.h"

namespace lozenge::bench {
namespace {

constexpr std::size_t kHeader = 80;    // bytes, before the number of triangles
constexpr std::size_t kTriangle = 50;  // bytes: a normal, three corners, a number of two bytes

template <typename T>
T at(std::string_view bytes, std::size_t offset) {
  static_assert(std::endian::native == std::endian::little, "STL is little-endian");
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

void add_triangle(const std::array<std::array<double, 3>, 3>& corners, PolygonMesh& mesh) {
  const std::int64_t first = mesh.vertices();
  for (const auto& [x, y, z] : corners) mesh.add_vertex(x, y, z);
  mesh.add_polygon(std::array<std::int64_t, 3>{first, first + 1, first + 2});
}

/// Texts may begin as bytes do, and the other way around; the length tells.
bool is_binary(std::string_view bytes) {
  return bytes.size() >= kHeader + 4 &&
         bytes.size() == kHeader + 4 + kTriangle * std::uint64_t{at<std::uint32_t>(bytes, kHeader)};
}

void read_bytes(std::string_view bytes, PolygonMesh& mesh) {
  for (std::size_t offset = kHeader + 4; offset < bytes.size(); offset += kTriangle) {
    std::array<std::array<double, 3>, 3> corners{};
    for (std::size_t i = 0; i < 9; ++i) corners[i / 3][i % 3] = at<float>(bytes, offset + 12 + 4 * i);
    add_triangle(corners, mesh);
  }
}

void expect(TextScanner& scanner, std::string_view word) {
  if (scanner.word() != word) scanner.refuse(fmt::format("'{}' was expected", word));
}

void read_text(TextScanner& scanner, PolygonMesh& mesh) {
  for (;;) {
    const std::string_view word = scanner.word();
    if (word.empty()) return;
    if (word == "solid" || word == "endsolid") {
      scanner.next_line();
      continue;
    }
    if (word != "facet") scanner.refuse(fmt::format("'{:.40}' stands where a facet should", word));
    scanner.next_line();
    expect(scanner, "outer");
    expect(scanner, "loop");
    std::array<std::array<double, 3>, 3> corners{};
    for (auto& corner : corners) {
      expect(scanner, "vertex");
      for (double& x : corner) x = scanner.number("a coordinate");
    }
    expect(scanner, "endloop");
    expect(scanner, "endfacet");
    add_triangle(corners, mesh);
  }
}

}  // namespace

void read_stl(std::string_view bytes, const std::string& file, PolygonMesh& mesh) {
  if (is_binary(bytes)) return read_bytes(bytes, mesh);
  TextScanner scanner(bytes, file);
  if (scanner.word() != "solid") {
    throw Error(ExitCode::kUnusableInput,
                file + ": is neither a text that begins with 'solid' nor as long as its number of triangles says");
  }
  scanner.next_line();
  read_text(scanner, mesh);
}

}  // namespace lozenge::bench
