// lozenge bake: a parameterized surface and its geometry image -> texture maps.
#include "stages/bake/bake.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "pipeline/map_files.h"
#include "pipeline/output_set.h"
#include "pipeline/stage_clock.h"
#include "stages/export/export.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  out/statue.normal.png and out/statue.occlusion.png\n"
    "    lozenge bake statue.map.glb statue.gim.exr -o out/statue\n"
    "  for a coarser level of detail, with 16 bits a channel\n"
    "    lozenge bake statue.map.glb statue.gim.exr -o out/statue --triangles 10000 --map-bits 16\n"
    "  the position of the source at every texel, as floating-point EXR\n"
    "    lozenge bake statue.map.glb statue.gim.exr -o out/statue --maps position";

struct Arguments {
  std::string map;
  std::string image;
  std::string output;
  BakeOptions options;
  MapFiles files;
  ExportOptions level;
};

const std::map<std::string, MapFormat> kFormats = {{"png", MapFormat::kPng}, {"exr", MapFormat::kExr}};
const std::map<std::string, Projection> kProjections = {{"rays", Projection::kRays},
                                                        {"correspondence", Projection::kCorrespondence}};

/// [option] all kinds of maps.
std::map<std::string, MapKind> kinds_by_option() {
  std::map<std::string, MapKind> kinds;
  for (const MapTraits& traits : kMapKinds) kinds.emplace(traits.option, traits.kind);
  return kinds;
}

std::string options_of(std::span<const MapKind> kinds, std::string_view between) {
  std::string list;
  for (const MapKind kind : kinds) list.append(list.empty() ? "" : between).append(traits_of(kind).option);
  return list;
}

/// "Any of normal, object-normal, occlusion, position [normal occlusion]"
std::string help_on_maps(const BakeOptions& options) {
  std::vector<MapKind> all;
  for (const MapTraits& traits : kMapKinds) all.push_back(traits.kind);
  return fmt::format("Any of {} [{}]", options_of(all, ", "), options_of(options.maps, " "));
}

/// Writes all maps or none, as FOLDER/NAME.normal.png for the output FOLDER/NAME.
void write_together(const std::filesystem::path& output, const BakedMaps& maps, const MapFiles& files) {
  if (!output.has_filename())
    throw Error(ExitCode::kUsage, "-o: ends in a folder; add the name that the maps begin with");
  OutputSet outputs(output.has_parent_path() ? output.parent_path() : ".");
  write_maps(outputs.staging_folder(), output.filename().string(), maps, files);
  outputs.commit();
}

ExitCode run(const Arguments& arguments, Console& console) {
  StageClock clock;
  clock.begin("bake");
  const auto [mesh, map] = read_parameterization(arguments.map);
  const GeometryImage image = read_geometry_image(arguments.image);
  BakeOptions options = arguments.options;
  options.level = level_to_export(image, arguments.level);
  const BakedMaps maps = bake(mesh, map, image, options, console.progress());
  write_together(arguments.output, maps, arguments.files);
  QualityReport report;
  report.input = arguments.map;
  report.patches = patch_facts(image);
  report.bake = maps.statistics;
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void add_file_options(CLI::App& command, MapFiles& files) {
  constexpr const char* kGroup = "Maps";
  command.add_option("--map-format", files.format, "png, or exr (floating point) [png]")
      ->transform(CLI::CheckedTransformer(kFormats).description(""))
      ->type_name("NAME")
      ->group(kGroup);
  command.add_option("--map-bits", files.bits, "Bits a channel of normal maps in a PNG: 8 or 16")
      ->check(CLI::IsMember({8, 16}).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
}

void add_ray_options(CLI::App& command, BakeOptions& options) {
  constexpr const char* kGroup = "How maps take over the source";
  command
      .add_option("--projection", options.projection,
                  "rays from the level of detail, or the map's own correspondence [rays]")
      ->transform(CLI::CheckedTransformer(kProjections).description(""))
      ->type_name("NAME")
      ->group(kGroup);
  command
      .add_option_function<double>(
          "--cage", [&options](double distance) { options.cage_distance = distance; },
          "How far rays go, in the asset's units; without it, measured")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("LENGTH")
      ->group(kGroup);
}

void add_occlusion_options(CLI::App& command, BakeOptions& options) {
  constexpr const char* kGroup = "Ambient occlusion";
  command.add_option("--occlusion-size", options.occlusion_size, "Side of the map, in texels")
      ->check(CLI::Range(16, 16384).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--occlusion-rays", options.occlusion_rays, "Rays a texel")
      ->check(CLI::Range(1, 65536).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option("--occlusion-distance", options.occlusion_distance,
                  "What is farther away doesn't darken, in the asset's units; without it, everything does")
      ->check(CLI::PositiveNumber.description(""))
      ->type_name("LENGTH")
      ->group(kGroup);
}

}  // namespace

void add_bake_options(CLI::App& command, BakeOptions& options, MapFiles& files) {
  constexpr const char* kGroup = "Maps";
  command.add_option("--maps", options.maps, help_on_maps(options))
      ->transform(CLI::CheckedTransformer(kinds_by_option()).description(""))
      ->type_name("NAME")
      ->group(kGroup);
  command.add_option("--map-size", options.size, "Side of the square maps, in texels")
      ->check(CLI::Range(16, 16384).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
  command.add_option("--gutter", options.gutter, "Texels around each patch that repeat its neighbours")
      ->check(CLI::Range(0, 64).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->group(kGroup);
  add_file_options(command, files);
  add_ray_options(command, options);
  add_occlusion_options(command, options);
}

void add_bake_command(CLI::App& app, Request& request) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(app, request, {"bake", "Take texture maps over from the source surface", kStageGroup, kExamples},
                  [arguments](Console& console) { return run(*arguments, console); });
  add_input(*command, "source", arguments->map, "The parameterized source that `lozenge parameterize` wrote");
  add_input(*command, "image", arguments->image, "The geometry image that `lozenge pack` made of it");
  add_output(*command, arguments->output, "What the names of the maps begin with, as out/statue");
  add_level_options(*command, "--samples", arguments->level);
  add_bake_options(*command, arguments->options, arguments->files);
}

}  // namespace lozenge
