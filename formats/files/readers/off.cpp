// How many numbers a colour has, the keyword doesn't say: so the line of a vertex is read to its end. After a position
// come a normal, a colour and texture coordinates, as far as the keyword has their prefixes.
#include "formats/files/readers/off.h"

#include <fmt/format.h>

#include <vector>

#include "formats/base/error.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/readers/polygon_mesh.h"
#include "formats/files/readers/text_scanner.h"
#include "formats/files/readers/vertex_colors.h"

namespace lozenge {

namespace {

/// The word that says what vertices have.
struct Keyword {
  bool is_one = false;
  bool has_uvs = false;
  bool has_colors = false;
  bool has_normals = false;
  bool has_other_dimension = false;
};

Keyword keyword_of(std::string_view word) {
  Keyword keyword;
  const auto take = [&](std::string_view prefix) {
    const bool there = word.starts_with(prefix);
    if (there) word.remove_prefix(prefix.size());
    return there;
  };
  keyword.has_uvs = take("ST");
  keyword.has_colors = take("C");
  keyword.has_normals = take("N");
  const bool four = take("4");
  keyword.has_other_dimension = take("n") || four;
  keyword.is_one = word == "OFF";
  return keyword;
}

/// What follows a position.
void add_attributes(const std::vector<float>& values, const Keyword& keyword, PolygonMesh& mesh) {
  std::size_t begin = 0;
  std::size_t end = values.size();
  if (keyword.has_normals) {
    const bool there = end >= 3;
    mesh.add_normal(there ? Vec3f(values[0], values[1], values[2]) : Vec3f(0, 0, 0));
    begin = there ? 3 : end;
  }
  if (keyword.has_uvs) {
    const bool there = end >= begin + 2;
    mesh.add_uv(there ? Vec2f(values[end - 2], values[end - 1]) : Vec2f(0, 0));
    if (there) end -= 2;
  }
  // A single number would name a row of somebody's table of colours.
  if (keyword.has_colors && end >= begin + 3) {
    const float alpha = end > begin + 3 ? values[begin + 3] : kOpaque;
    mesh.add_color({values[begin], values[begin + 1], values[begin + 2], alpha});
  }
}

void read_vertex(TextScanner& scanner, const Keyword& keyword, std::vector<float>& values, PolygonMesh& mesh) {
  constexpr std::size_t kMostValues = 16;
  Vec3f position;
  for (int axis = 0; axis < 3; ++axis) position[axis] = scanner.float_number("a coordinate");
  mesh.add_position(position, scanner.line());
  values.clear();
  float value = 0;
  while (values.size() < kMostValues && parse_float(scanner.word_of_line(), value)) values.push_back(value);
  add_attributes(values, keyword, mesh);
  scanner.next_line();
}

void read_face(TextScanner& scanner, const Keyword& keyword, std::vector<PolygonCorner>& corners, PolygonMesh& mesh) {
  const std::int64_t size = scanner.count("the number of corners of a face", 2);
  const std::int64_t line = scanner.line();
  mesh.require_sensible_polygon(static_cast<std::uint64_t>(size), line);
  corners.clear();
  for (std::int64_t k = 0; k < size; ++k) {
    const std::int64_t v = scanner.integer("a corner of a face");
    corners.push_back({v, keyword.has_uvs ? v : -1, keyword.has_normals ? v : -1});
  }
  mesh.add_polygon(corners, line);
  scanner.next_line();
}

/// Takes the keyword, if there is one, and the number of vertices.
std::int64_t read_start(TextScanner& scanner, const std::string& name, Keyword& keyword) {
  // "0 0 0" and the end of a line.
  constexpr std::uint64_t kLeastVertex = 6;
  const char* what = "the number of vertices";
  const std::string first(scanner.word());
  keyword = keyword_of(first);
  if (!keyword.is_one) {
    std::int64_t count = 0;
    if (!parse_integer(first, count)) {
      scanner.refuse("the file doesn't begin with OFF, COFF, NOFF or the like, nor with the number of vertices");
    }
    return scanner.as_count(count, what, kLeastVertex);
  }
  if (keyword.has_other_dimension) {
    throw Error(ExitCode::kUnsupported, name + ": has points of other than three coordinates; give a plain OFF");
  }
  if (scanner.window().ahead(7).starts_with(" BINARY")) {
    throw Error(ExitCode::kUnsupported, name + ": is a binary OFF; save it as ASCII");
  }
  return scanner.count(what, kLeastVertex);
}

}  // namespace

Likeness likeness_to_off(const InputStart& start) {
  std::size_t at = 0;
  return keyword_of(next_word(without_mark(start.bytes), at)).is_one ? Likeness::kSure : Likeness::kIfNamedSo;
}

InputAsset read_off(const std::filesystem::path& path, const InputLimits& limits) {
  const std::string name = file_name_of(path);
  TextScanner scanner(InputFile(path, name));
  Keyword keyword;
  const std::int64_t vertices = read_start(scanner, name, keyword);
  const std::int64_t faces = scanner.count("the number of faces", 2);
  scanner.next_line();
  PolygonMesh mesh(name, limits, {});
  mesh.reserve(static_cast<std::uint64_t>(vertices), static_cast<std::uint64_t>(faces));
  std::vector<float> values;
  for (std::int64_t v = 0; v < vertices; ++v) read_vertex(scanner, keyword, values, mesh);
  std::vector<PolygonCorner> corners;
  for (std::int64_t f = 0; f < faces; ++f) read_face(scanner, keyword, corners, mesh);
  return mesh.finish();
}

}  // namespace lozenge
