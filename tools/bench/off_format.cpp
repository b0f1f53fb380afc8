// OFF: a keyword, the counts of vertices, faces and edges, then a line for each vertex and each face. Normals, colours
// and texture coordinates may follow on a line, how many is often left open: so only the start of a line is read.
#include <fmt/format.h>

#include <vector>

#include "formats/base/error.h"
#include "tools/bench/mesh_formats.h"
#include "tools/bench/text_scanner.h"

namespace lozenge::bench {
namespace {

/// Takes the keyword, and leaves the scanner before the counts.
void read_keyword(TextScanner& scanner, const std::string& file) {
  std::string_view keyword = scanner.word();
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (keyword.starts_with(prefix)) keyword.remove_prefix(prefix.size());
  }
  if (keyword == "4OFF" || keyword == "nOFF" || keyword == "4nOFF") {
    throw Error(ExitCode::kUnsupported, file + ": has points of other than three coordinates; give a plain OFF");
  }
  if (keyword != "OFF") scanner.refuse("the file doesn't begin with OFF, COFF, NOFF or the like");
}

std::int64_t read_count(TextScanner& scanner, const char* what) {
  const std::int64_t count = scanner.integer(what);
  if (count < 0) scanner.refuse(fmt::format("{} is {}, less than nothing", what, count));
  return count;
}

void read_vertex(TextScanner& scanner, PolygonMesh& mesh) {
  const double x = scanner.number("a coordinate");
  const double y = scanner.number("a coordinate");
  const double z = scanner.number("a coordinate");
  mesh.add_vertex(x, y, z);
  scanner.next_line();
}

void read_face(TextScanner& scanner, std::vector<std::int64_t>& corners, PolygonMesh& mesh) {
  const std::int64_t size = read_count(scanner, "the number of corners of a face");
  corners.clear();
  for (std::int64_t k = 0; k < size; ++k) corners.push_back(scanner.integer("a corner of a face"));
  mesh.add_polygon(corners);
  scanner.next_line();
}

}  // namespace

void read_off(std::string_view text, const std::string& file, PolygonMesh& mesh) {
  TextScanner scanner(text, file);
  read_keyword(scanner, file);
  if (scanner.rest().substr(0, 7) == " BINARY") {
    throw Error(ExitCode::kUnsupported, file + ": is a binary OFF; save it as ASCII");
  }
  const std::int64_t vertices = read_count(scanner, "the number of vertices");
  const std::int64_t faces = read_count(scanner, "the number of faces");
  scanner.next_line();
  for (std::int64_t v = 0; v < vertices; ++v) read_vertex(scanner, mesh);
  std::vector<std::int64_t> corners;
  for (std::int64_t f = 0; f < faces; ++f) read_face(scanner, corners, mesh);
}

}  // namespace lozenge::bench
