#include "pipeline/import_notes.h"

#include <fmt/format.h>

namespace lozenge {
namespace {

/// "1 line", "3 lines".
std::string counted(std::int64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

}  // namespace

std::vector<std::string> import_notes(const ImportReport& report) {
  std::vector<std::string> lines = report.notes;
  if (report.dropped_triangles > 0) {
    lines.push_back(counted(report.dropped_triangles, "triangle", "triangles") +
                    " left out: two corners are one point");
  }
  if (report.ignored_primitives > 0) {
    lines.push_back(counted(report.ignored_primitives, "primitive", "primitives") + " of points or lines left out");
  }
  if (report.repaired_attributes > 0) {
    lines.push_back(counted(report.repaired_attributes, "attribute", "attributes") +
                    " (normals, UVs, colours) repaired: not a number, or out of range");
  }
  return lines;
}

}  // namespace lozenge
