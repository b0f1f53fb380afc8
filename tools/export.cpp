// lozenge export: a geometry image and its maps -> what an engine loads.
#include "stages/export/export.h"

#include <fmt/format.h>

#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "pipeline/stage_clock.h"
#include "tools/command_input.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  an asset with its baked maps and coarser levels of detail\n"
    "    lozenge export statue.gim.exr --map statue.normal.png statue.occlusion.png -o statue.glb\n"
    "  at most 10,000 triangles, fitted to the source\n"
    "    lozenge export statue.gim.exr --source statue.map.glb --map statue.normal.png --triangles 10000 -o "
    "statue.glb\n"
    "  each level of detail as a file of its own, for engines that don't know MSFT_lod\n"
    "    lozenge export statue.gim.exr --separate-lods -o statue.glb";

struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> maps;
  std::string source;
  ExportOptions options;
};

/// \param has_source  levels are fitted to it, and take normals from those of any
BakedMap read_map_of_level(const std::string& file, int level, bool has_source) {
  BakedMap map = read_input(file, FileKind::kMapPng, "export", read_map);
  if (has_source || map.level == level) return map;
  throw Error(ExitCode::kUsage, fmt::format("{}: was baked for level of detail {}, but level {} is exported; give both "
                                            "commands the same --samples or --triangles",
                                            file_name(file), map.level, level));
}

AssetFacts export_with_source(const Arguments& arguments, const GeometryImage& image, const BakedMaps& maps) {
  if (arguments.source.empty()) return export_asset(arguments.output, image, maps, arguments.options);
  const auto [mesh, map] = read_input(arguments.source, FileKind::kParameterization, "export", read_parameterization);
  const SourceSurface source{&mesh, &map};
  return export_asset(arguments.output, image, maps, arguments.options, &source);
}

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  StageClock clock;
  clock.begin("export");
  const GeometryImage image = read_input(arguments.input, FileKind::kGeometryImage, "export", read_geometry_image);
  BakedMaps maps;
  maps.level = level_to_export(image, arguments.options);
  for (const std::string& file : arguments.maps) {
    maps.maps.push_back(read_map_of_level(file, maps.level, !arguments.source.empty()));
  }
  const AssetFacts facts = export_with_source(arguments, image, maps);
  if (!facts.note.empty()) console.note(arguments.input, facts.note);
  QualityReport report;
  report.input = arguments.input;
  report.patches = patch_facts(image);
  report.asset = asset_quality(facts);
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input, "The geometry image that `lozenge pack` wrote");
  options.output(arguments.output, "The asset, a .glb");
  options.group("Asset");
  options.texts("--map FILE", arguments.maps, "Maps that `lozenge bake` wrote for this level of detail").names_inputs();
  options
      .text("--source FILE", arguments.source,
            "The map that the geometry image was sampled from, a .map.glb: the source level needs it, "
            "and what moves")
      .names_inputs();
  add_level_options(options, "--samples", arguments.options);
  add_export_options(options, arguments.options);
  options
      .number("--error P", arguments.options.error, {0, 100},
              "Samples that are farther from the source (root mean square), in percent of its box's diagonal, are no "
              "match for "
              "its own triangles")
      .shows_default();
}

}  // namespace

Command export_command() {
  return repeatable(make_command<Arguments>({"export", "Write the asset that an engine loads", kStageGroup, kExamples},
                                            declare, run));
}

}  // namespace lozenge
