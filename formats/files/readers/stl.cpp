// Text and bytes may begin alike ("solid" is allowed in the 80 bytes that nobody reads): a file of exactly the length
// that its number of triangles asks for is bytes, else one that begins with "solid" and has no zero byte soon is text.
#include "formats/files/readers/stl.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

#include "formats/base/error.h"
#include "formats/base/utf8.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/readers/polygon_mesh.h"
#include "formats/files/readers/text_scanner.h"

namespace lozenge {

namespace {

constexpr std::size_t kHeader = 84;    // bytes, the number of triangles at its end
constexpr std::size_t kTriangle = 50;  // bytes: a normal, three corners, a number of two bytes

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

std::uint64_t length_by_header(std::string_view start) {
  std::uint32_t triangles = 0;
  std::memcpy(&triangles, start.data() + kHeader - 4, 4);
  return kHeader + kTriangle * std::uint64_t{triangles};
}

bool begins_as_text(std::string_view start) {
  std::size_t at = 0;
  return in_lower_case(next_word(start, at)) == "solid" && start.find('\0') == std::string_view::npos;
}

void add_triangle(const std::array<Vec3f, 3>& corners, std::int64_t place, PolygonMesh& mesh) {
  const std::int64_t first = mesh.positions();
  for (const Vec3f& corner : corners) mesh.add_position(corner, place);
  mesh.add_polygon(std::array<PolygonCorner, 3>{{{first}, {first + 1}, {first + 2}}}, place);
}

InputAsset read_bytes(InputFile file, const InputLimits& limits) {
  InputWindow window(std::move(file));
  const std::string name = window.what();
  if (window.left() < kHeader) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("{}: is neither a text that begins with 'solid' nor long enough for a binary STL, which has "
                    "{} bytes at least; it has {}",
                    name, kHeader, window.left()));
  }
  const std::uint64_t length = length_by_header(window.ahead(kHeader));
  if (length > window.left()) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("{}: is no text that begins with 'solid', and as a binary STL it ends too early: by the "
                            "number of triangles at byte 80 it has {} bytes, but there are {}; copy or export it again",
                            name, length, window.left()));
  }
  const std::uint64_t triangles = (length - kHeader) / kTriangle;
  PolygonMesh mesh(name, limits, {.unit = "byte"});
  mesh.reserve(3 * triangles, triangles);
  window.skip(kHeader);
  for (std::uint64_t t = 0; t < triangles; ++t) {
    std::array<float, 9> c{};
    std::memcpy(c.data(), window.ahead(kTriangle).data() + 12, sizeof(c));
    add_triangle({Vec3f(c[0], c[1], c[2]), Vec3f(c[3], c[4], c[5]), Vec3f(c[6], c[7], c[8])},
                 static_cast<std::int64_t>(window.offset()), mesh);
    window.skip(kTriangle);
  }
  return mesh.finish();
}

void expect(TextScanner& scanner, std::string_view word) {
  const std::string_view found = scanner.word();
  if (in_lower_case(found) == word) return;
  scanner.refuse(found.empty()
                     ? fmt::format("the file ends where '{}' is expected", word)
                     : fmt::format("'{}' stands where '{}' is expected", valid_utf8(found.substr(0, 40)), word));
}

InputAsset read_text(InputFile file, const InputLimits& limits) {
  PolygonMesh mesh(file.what(), limits, {});
  TextScanner scanner(std::move(file));
  for (;;) {
    const std::string word = in_lower_case(scanner.word());
    if (word.empty()) return mesh.finish();
    if (word == "solid" || word == "endsolid") {
      scanner.next_line();
      continue;
    }
    if (word != "facet") {
      scanner.refuse(fmt::format("'{}' stands where a facet should", valid_utf8(word.substr(0, 40))));
    }
    const std::int64_t line = scanner.line();
    expect(scanner, "normal");
    for (int k = 0; k < 3; ++k) scanner.word();  // some write numbers that are none
    expect(scanner, "outer");
    expect(scanner, "loop");
    std::array<Vec3f, 3> corners;
    for (Vec3f& corner : corners) {
      expect(scanner, "vertex");
      for (int axis = 0; axis < 3; ++axis) corner[axis] = scanner.float_number("a coordinate");
    }
    expect(scanner, "endloop");
    expect(scanner, "endfacet");
    add_triangle(corners, line, mesh);
  }
}

}  // namespace

Likeness likeness_to_stl(const InputStart& start) {
  const bool of_bytes = start.bytes.size() >= kHeader && length_by_header(start.bytes) == start.size;
  return of_bytes || begins_as_text(start.bytes) ? Likeness::kSure : Likeness::kIfNamedSo;
}

InputAsset read_stl(const std::filesystem::path& path, const InputLimits& limits) {
  const InputStart start = start_of(path);
  const bool of_bytes = start.bytes.size() >= kHeader && length_by_header(start.bytes) == start.size;
  InputFile file(path, file_name_of(path));
  return of_bytes || !begins_as_text(start.bytes) ? read_bytes(std::move(file), limits)
                                                  : read_text(std::move(file), limits);
}

}  // namespace lozenge
