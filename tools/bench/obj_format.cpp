// OBJ: one statement a line, whose first word says what it is. A backslash at the end of a line continues it.
#include <fmt/format.h>

#include <vector>

#include "tools/bench/mesh_formats.h"
#include "tools/bench/text_scanner.h"

namespace lozenge::bench {
namespace {

/// The next word of the statement; empty at its end.
std::string_view word_of_statement(TextScanner& scanner) {
  std::string_view word = scanner.word_of_line();
  while (word == "\\" && scanner.next_line()) word = scanner.word_of_line();
  return word;
}

void read_vertex(TextScanner& scanner, PolygonMesh& mesh) {
  double at[3] = {0, 0, 0};
  for (double& coordinate : at) {
    const std::string_view word = word_of_statement(scanner);
    if (!parse_number(word, coordinate)) scanner.refuse(fmt::format("a coordinate is '{:.40}', no number", word));
  }
  mesh.add_vertex(at[0], at[1], at[2]);
}

/// Counted from 0. OBJ counts from 1, and backwards from the vertices so far where the number is negative.
std::int64_t corner_of(std::string_view word, const TextScanner& scanner, std::int64_t vertices) {
  std::int64_t index = 0;
  if (!parse_integer(word.substr(0, word.find('/')), index) || index == 0) {
    scanner.refuse(fmt::format("'{:.40}' is no corner of a face", word));
  }
  return index > 0 ? index - 1 : vertices + index;
}

}  // namespace

void read_obj(std::string_view text, const std::string& file, PolygonMesh& mesh) {
  TextScanner scanner(text, file);
  // Faces come last: they may be written before the vertices that they name.
  std::vector<std::vector<std::int64_t>> faces;
  do {
    const std::string_view statement = scanner.word_of_line();
    if (statement == "v") {
      read_vertex(scanner, mesh);
    } else if (statement == "f") {
      std::vector<std::int64_t> corners;
      for (std::string_view w = word_of_statement(scanner); !w.empty(); w = word_of_statement(scanner)) {
        corners.push_back(corner_of(w, scanner, mesh.vertices()));
      }
      faces.push_back(std::move(corners));
    }
  } while (scanner.next_line());
  for (const std::vector<std::int64_t>& corners : faces) mesh.add_polygon(corners);
}

}  // namespace lozenge::bench
