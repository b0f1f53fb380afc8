// lozenge build: the whole way, from an asset to what an engine loads.
#include "pipeline/build.h"

#include <fmt/format.h>

#include "tools/commands.h"
#include "tools/memory_limit.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  the whole way with sensible defaults: asset, geometry image, maps and preview in out/\n"
    "    lozenge build statue.glb -o out/\n"
    "  the same of a scan or a sculpt\n"
    "    lozenge build scan.ply -o out/\n"
    "    lozenge build sculpt.obj -o out/\n"
    "  a finer geometry image, but at most 20,000 triangles in the asset\n"
    "    lozenge build statue.glb -o out/ --samples 33 --triangles 20000\n"
    "  a smaller domain, with larger patches and more distortion\n"
    "    lozenge build statue.glb -o out/ --domain-faces 40..80\n"
    "  in a build system: one thread, no talk, all numbers in a file\n"
    "    lozenge build statue.glb -o out/ --threads 1 --quiet --report out/statue.report.json";

struct Arguments {
  std::string input;
  std::string folder;
  std::string report;
  bool no_preview = false;
  BuildOptions options;
};

/// The report's lines, and the files.
std::vector<std::string> result_lines(const BuildResult& result) {
  std::vector<std::string> lines = report_lines(result.report);
  for (const std::filesystem::path& file : result.files) lines.push_back("wrote       " + file.string());
  return lines;
}

ExitCode run(const Arguments& arguments, Console& console) {
  BuildOptions options = arguments.options;
  limit_memory(options.import.max_memory);
  options.folder = arguments.folder;
  options.asset.error = options.sample.error;
  options.report = arguments.report;
  options.preview = !arguments.no_preview;
  options.stage_done = [&](const StageCost& cost) {
    console.say(fmt::format("{} done in {:.2f} s, {:.0f} MB", cost.name, cost.seconds, cost.peak_memory_mb));
  };
  const BuildResult result = build_asset(arguments.input, options, console.progress());
  for (const std::string& note : result.notes) console.say(arguments.input + ": " + note);
  console.print(result_lines(result), report_json(result.report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  BuildOptions& build = arguments.options;
  options.input("input", arguments.input, "The asset: glTF, PLY, OBJ, STL or OFF");
  options.output(arguments.folder, "The folder for NAME.glb, NAME.gim.exr and all others; made if need be");
  options.text("--name NAME", build.name, "NAME of the outputs; without it, that of the input");
  options.text("--report FILE", arguments.report, "Write all numbers of the run to this .json");
  options.flag("--no-preview", arguments.no_preview, "Don't draw NAME.preview.png");
  add_parameterize_options(options, build.parameterize);
  add_sample_options(options, build.sample);
  add_pack_options(options, build.pack);
  add_level_options(options, "--asset-samples", build.asset);
  add_bake_options(options, build.bake, build.maps);
  add_export_options(options, build.asset);
  add_import_options(options, build.import);
}

}  // namespace

Command build_command() {
  return make_command<Arguments>(
      {"build", "Make a game-ready asset of a mesh or a scene, all stages at once", kWholeGroup, kExamples}, declare,
      run);
}

}  // namespace lozenge
