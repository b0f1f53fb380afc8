// lozenge export: a geometry image and its maps -> what an engine loads.
#include "stages/export/export.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "pipeline/stage_clock.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  an asset with its baked maps and coarser levels of detail\n"
    "    lozenge export statue.gim.exr --map statue.normal.png statue.occlusion.png -o statue.glb\n"
    "  the finest level of detail that stays below 10,000 triangles (bake for it with the same option)\n"
    "    lozenge export statue.gim.exr --triangles 10000 -o statue.glb\n"
    "  each level of detail as a file of its own, for engines that don't know MSFT_lod\n"
    "    lozenge export statue.gim.exr --separate-lods -o statue.glb";

const std::map<std::string, Caps> kCaps = {{"keep", Caps::kKeep}, {"open", Caps::kOpen}};

struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> maps;
  ExportOptions options;
};

BakedMap read_map_of_level(const std::string& file, int level) {
  BakedMap map = read_map(file);
  if (map.level == level) return map;
  throw Error(ExitCode::kUsage, fmt::format("{}: was baked for level of detail {}, but level {} is exported; give both "
                                            "commands the same --samples or --triangles",
                                            file_name(file), map.level, level));
}

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  StageClock clock;
  clock.begin("export");
  const GeometryImage image = read_geometry_image(arguments.input);
  BakedMaps maps;
  maps.level = level_to_export(image, arguments.options);
  for (const std::string& file : arguments.maps) maps.maps.push_back(read_map_of_level(file, maps.level));
  const AssetFacts facts = export_asset(arguments.output, image, maps, arguments.options);
  QualityReport report;
  report.input = arguments.input;
  report.patches = patch_facts(image);
  report.asset = AssetQuality{facts.triangles, facts.vertices, {}, {}, {}};
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

}  // namespace

void add_level_options(CLI::App& command, const std::string& samples, ExportOptions& options) {
  constexpr const char* kGroup = "Level of detail";
  add_samples(command, samples, options.samples,
              "Samples a side of each patch in the asset, 2^k + 1; without it, all of the geometry image")
      ->group(kGroup);
  command.add_option("--triangles", options.triangle_budget, "As many of them as give at most this many triangles")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("BUDGET")
      ->group(kGroup);
}

void add_export_options(CLI::App& command, ExportOptions& options) {
  constexpr const char* kGroup = "Asset";
  command.add_option("--lods", options.max_coarser_levels, "At most this many coarser levels of detail in the asset")
      ->check(CLI::Range(0, 10).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--normal-bits", options.normal_bits, "Bits a channel of the normal map in the asset: 8 or 16")
      ->check(CLI::IsMember({8, 16}).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--caps", options.caps, "keep: what fills holes is part of the asset; open: it is left out [keep]")
      ->transform(CLI::CheckedTransformer(kCaps).description(""))
      ->type_name("NAME")
      ->group(kGroup);
  command.add_flag("--separate-lods", options.separate_files, "Also each coarser level of detail as a file of its own")
      ->group(kGroup);
}

void add_export_command(CLI::App& app, Request& request) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(app, request, {"export", "Write the asset that an engine loads", kStageGroup, kExamples},
                  [arguments](Console& console) { return run(*arguments, console); });
  add_input(*command, "input", arguments->input, "The geometry image that `lozenge pack` wrote");
  add_output(*command, arguments->output, "The asset, a .glb");
  command->add_option("--map", arguments->maps, "Maps that `lozenge bake` wrote for this level of detail")
      ->type_name("FILE")
      ->group("Asset");
  add_level_options(*command, "--samples", arguments->options);
  add_export_options(*command, arguments->options);
}

}  // namespace lozenge
