// lozenge import: any glTF -> one welded surface.
#include "stages/import/import.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "formats/quality_report.h"
#include "formats/source_mesh_file.h"
#include "pipeline/stage_clock.h"
#include "stages/import/surface.h"
#include "tools/commands.h"
#include "tools/options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  weld an asset into one surface\n"
    "    lozenge import statue.gltf -o statue.mesh.glb\n"
    "  only see whether Lozenge can take it, and what it is\n"
    "    lozenge import statue.gltf -o /tmp/statue.glb --json";

struct Arguments {
  std::string input;
  std::string output;
};

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  StageClock clock;
  clock.begin("import");
  ImportReport notes;
  const SourceMesh mesh = import_gltf(arguments.input, {}, console.progress(), &notes);
  QualityReport report;
  report.input = arguments.input;
  report.source = require_closed_surface(mesh, file_name(arguments.input));
  write_source_mesh(arguments.output, mesh);
  for (const std::string& line : notes.notes) console.say(arguments.input + ": " + line);
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

}  // namespace

void add_import_command(CLI::App& app, Request& request) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(app, request, {"import", "Join everything in a glTF into one welded surface", kStageGroup, kExamples},
                  [arguments](Console& console) { return run(*arguments, console); });
  add_input(*command, "input", arguments->input, "The asset: .glb or .gltf");
  add_output(*command, arguments->output, "The surface, a .glb that any viewer opens");
}

}  // namespace lozenge
