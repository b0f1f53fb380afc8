#include "stages/import/import_surface.h"

#include <fmt/format.h>

#include "formats/base/error.h"
#include "stages/import/fill_holes.h"
#include "stages/import/repair.h"
#include "stages/import/t_junctions.h"

namespace lozenge {

namespace {

void note_repairs(const ImportReport& facts, const ImportOptions& options, std::vector<std::string>& notes) {
  for (const std::string& line : repair_lines(facts.repairs)) notes.push_back(line);
  if (facts.repairs[RepairKind::kFilledHoles].count > 0) {
    notes.push_back(fmt::format(
        "holes of up to {:g} % of the box diagonal around are filled; --fill-holes 0 keeps them", options.fill_holes));
  }
}

}  // namespace

bool mend(SourceMesh& mesh, const ImportOptions& options, bool was_repaired, RepairReport& report) {
  if (!was_repaired) join_t_junctions(mesh, report);
  repair_surface(mesh, report);
  if (mesh.triangles.empty()) return false;
  fill_holes(mesh, options.fill_holes, report);
  return true;
}

SourceMesh import_surface(const std::filesystem::path& path, const ImportOptions& options, const Progress& progress,
                          ImportReport* result) {
  ImportReport facts;
  SourceMesh mesh = import_asset(path, options, progress, &facts);
  const std::string name = path.filename().string();
  report(progress, "repairing", 0);
  if (!mend(mesh, options, facts.was_repaired, facts.repairs)) {
    throw Error(ExitCode::kUnusableInput, name + ": none of its triangles has any area");
  }
  report(progress, "repairing", 1);
  if (options.strict && facts.deviations > 0) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("{}: {}; --strict forbids that: mend the file, or leave out --strict", name, facts.notes.front()));
  }
  if (options.strict && !facts.repairs.none()) {
    throw Error(ExitCode::kUnusableInput, fmt::format("{}: needs repair, which --strict forbids: {}; mend it, or leave "
                                                      "out --strict",
                                                      name, repair_lines(facts.repairs).front()));
  }
  note_repairs(facts, options, facts.notes);
  if (result != nullptr) *result = std::move(facts);
  return mesh;
}

}  // namespace lozenge
