// lozenge pack: patches -> a geometry image.
#include "stages/pack/pack.h"

#include <CLI/CLI.hpp>

#include "formats/files/geometry_image_file.h"
#include "formats/files/patch_set_file.h"
#include "pipeline/stage_clock.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  a geometry image with all its levels of detail, and its table as JSON beside it\n"
    "    lozenge pack statue.patches.exr -o statue.gim.exr";

struct Arguments {
  std::string input;
  std::string output;
  PackOptions options;
};

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  StageClock clock;
  clock.begin("pack");
  const GeometryImage image = pack(read_patch_set(arguments.input), arguments.options);
  write_geometry_image(arguments.output, image);
  QualityReport report;
  report.input = arguments.input;
  report.patches = patch_facts(image);
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

}  // namespace

void add_pack_options(CLI::App& command, PackOptions& options) {
  command
      .add_option("--columns", options.columns, "Patches side by side in the atlas; without it, as square as it gets")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("N")
      ->group("Geometry");
}

void add_pack_command(CLI::App& app, Request& request) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(app, request, {"pack", "Lay patches out as one geometry image", kStageGroup, kExamples},
                  [arguments](Console& console) { return run(*arguments, console); });
  add_input(*command, "input", arguments->input, "What `lozenge sample` wrote");
  add_output(*command, arguments->output, "The geometry image, an .exr; the .json of the same name comes beside it");
  add_pack_options(*command, arguments->options);
}

}  // namespace lozenge
