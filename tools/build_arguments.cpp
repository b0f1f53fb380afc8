#include "tools/build_arguments.h"

#include "formats/base/atomic_file.h"
#include "pipeline/output_name.h"
#include "pipeline/output_set.h"
#include "tools/program.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace fs = std::filesystem;
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
    "    lozenge build statue.glb -o out/ --threads 1 --quiet --report out/statue.report.json\n"
    "  nothing that was built before, and only what changed of the rest\n"
    "    lozenge build statue.glb -o out/ --cache ~/.cache/lozenge --depfile out/statue.d";

}  // namespace

fs::path BuildArguments::asset() const { return fs::path(folder) / (output_name(input, options.name) + ".glb"); }

CommandHelp build_help() {
  return {"build", "Make a game-ready asset of a mesh or a scene, all stages at once", kWholeGroup, kExamples};
}

void add_build_options(Options& options, BuildOptions& build, bool& no_preview) {
  options.stage("preview");
  options.flag("--no-preview", no_preview, "Don't draw NAME.preview.png");
  options.stage("parameterize");
  add_parameterize_options(options, build.parameterize);
  options.stage("sample");
  add_sample_options(options, build.sample);
  options.stage("pack");
  add_pack_options(options, build.pack);
  options.stage("export");
  add_level_options(options, "--asset-samples", build.asset);
  options.stage("bake");
  add_bake_options(options, build.bake, build.maps);
  options.stage("export");
  add_export_options(options, build.asset);
  options.flag("--arrays", build.arrays, "Also NAME.npz: all samples, maps and tables as arrays for NumPy");
  options.stage("import");
  add_import_options(options, build.import);
  options.stage("");
}

void declare_build(Options& options, BuildArguments& arguments) {
  options.input("input", arguments.input, "The asset: glTF, PLY, OBJ, STL or OFF");
  options.output(arguments.folder, "The folder for NAME.glb, NAME.gim.exr and all others; made if need be");
  options.text("--name NAME", arguments.options.name, "NAME of the outputs; without it, that of the input");
  options.report(arguments.report, "Write all numbers of the run to this .json");
  add_build_options(options, arguments.options, arguments.no_preview);
}

void print_build(const std::vector<std::string>& report_lines, const std::string& json,
                 const std::vector<fs::path>& files, Console& console) {
  std::vector<std::string> lines = report_lines;
  for (const fs::path& file : files) lines.push_back("wrote       " + file.string());
  console.print(lines, json);
}

bool recall_build(const BuildArguments& arguments, Console& console, Recall& recall) {
  if (!recall.is_on()) return false;
  refuse_to_replace_input(arguments.input, arguments.asset());
  const std::optional<CacheEntry> entry = recall.find(recall.key());
  if (!entry) return false;
  OutputSet outputs(arguments.folder);
  const std::optional<std::string> text = entry->text(kTalkPart);
  const std::optional<Console::Talk> talk = text ? talk_of(*text, arguments.input) : std::nullopt;
  bool is_sound = talk.has_value();
  for (const std::string& name : entry->names()) {
    if (name != kTalkPart) is_sound = is_sound && entry->extract(name, outputs.staged(name));
  }
  if (!is_sound) {
    recall.cache().discard(recall.key());
    return false;
  }
  if (!arguments.report.empty()) write_file_whole(arguments.report, talk->json + "\n");
  const std::vector<fs::path> files = outputs.commit(arguments.asset().filename().string());
  recall.write_depfile(arguments.asset());
  console.say("taken from the cache");
  for (const std::string& note : talk->notes) console.note(arguments.input, note);
  print_build(talk->lines, talk->json, files, console);
  return true;
}

std::optional<int> run_recalled_build(const fs::path& builder, int argc, const char* const* argv) {
  BuildArguments arguments;
  bool is_understood = false;
  bool is_recalled = false;
  const auto run = [&](Console& console, Recall& recall) {
    is_understood = true;
    is_recalled = recall_build(arguments, console, recall);
    return ExitCode::kDone;
  };
  const Command command{build_help(), [&](Options& options) { declare_build(options, arguments); }, run, true, true};
  const int code = run_commands({command}, {.worker = builder}, argc, argv);
  if (is_understood && !is_recalled && code == static_cast<int>(ExitCode::kDone)) return std::nullopt;
  return code;
}

}  // namespace lozenge
