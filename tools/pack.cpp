// lozenge pack: patches -> a geometry image.
#include "stages/pack/pack.h"

#include "formats/files/geometry_image_file.h"
#include "formats/files/patch_set_file.h"
#include "pipeline/quality/stage_clock.h"
#include "tools/command_input.h"
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
  const GeometryImage image =
      pack(read_input(arguments.input, FileKind::kPatchSet, "pack", read_patch_set), arguments.options);
  write_geometry_image(arguments.output, image);
  QualityReport report;
  report.input = arguments.input;
  report.patches = patch_facts(image);
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input, "What `lozenge sample` wrote");
  options.output(arguments.output, "The geometry image, an .exr; the .json of the same name comes beside it");
  add_pack_options(options, arguments.options);
}

}  // namespace

void add_pack_options(Options& options, PackOptions& pack) {
  options.group("Geometry");
  options.number("--columns N", pack.columns, {1},
                 "Patches side by side in the atlas; without it, as square as it gets");
}

Command pack_command() {
  return repeatable(
      make_command<Arguments>({"pack", "Lay patches out as one geometry image", kStageGroup, kExamples}, declare, run));
}

}  // namespace lozenge
