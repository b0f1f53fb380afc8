// lozenge export: a geometry image and its maps -> what an engine loads.
#include "stages/export/export.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "formats/files/baked_maps_file.h"
#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "pipeline/arrays.h"
#include "pipeline/quality/stage_clock.h"
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
    "    lozenge export statue.gim.exr --separate-lods -o statue.glb\n"
    "  arrays for NumPy: samples, neighbours, maps, and where on the source samples lie\n"
    "    lozenge export statue.gim.exr --as npz --source statue.map.glb --map statue.normal.png -o statue.npz";

enum class Form : std::uint8_t { kAsset, kNpz, kPng16 };

struct Arguments {
  std::string input;
  std::string output;
  std::vector<std::string> maps;
  std::string source;
  Form form = Form::kAsset;
  ExportOptions options;
};

/// The surface that the geometry image was sampled from, if it was named.
using Source = std::optional<std::pair<SourceMesh, Parameterization>>;

Source read_source(const std::string& file) {
  if (file.empty()) return std::nullopt;
  auto [mesh, map] = read_input(file, FileKind::kParameterization, "export", read_parameterization);
  return std::pair(std::move(mesh), std::move(map));
}

/// \param has_source  levels are fitted to it, and take normals from those of any
BakedMap read_map_of_level(const std::string& file, int level, bool has_source) {
  BakedMap map = read_input(file, FileKind::kMapPng, "export", read_map);
  if (has_source || map.level == level) return map;
  throw Error(ExitCode::kUsage, fmt::format("{}: was baked for level of detail {}, but level {} is exported; give both "
                                            "commands the same --samples or --triangles",
                                            file_name(file), map.level, level));
}

AssetFacts export_with_source(const Arguments& arguments, const GeometryImage& image, const BakedMaps& maps) {
  const Source source = read_source(arguments.source);
  if (!source) return export_asset(arguments.output, image, maps, arguments.options);
  const SourceSurface surface{&source->first, &source->second};
  return export_asset(arguments.output, image, maps, arguments.options, &surface);
}

BakedMaps read_maps_for_asset(const Arguments& arguments, const GeometryImage& image) {
  BakedMaps maps;
  maps.level = level_to_export(image, arguments.options);
  for (const std::string& file : arguments.maps) {
    maps.maps.push_back(read_map_of_level(file, maps.level, !arguments.source.empty()));
  }
  return maps;
}

/// The arrays hold all levels of detail: there is none to choose.
void export_arrays(const Arguments& arguments, const GeometryImage& image, Console& console) {
  if (arguments.options.samples > 0 || arguments.options.triangle_budget > 0) {
    throw Error(ExitCode::kUsage, "--samples and --triangles choose a level of detail for an asset; arrays hold all");
  }
  BakedMaps maps;
  for (const std::string& file : arguments.maps) {
    maps.maps.push_back(read_input(file, FileKind::kMapPng, "export", read_map));
  }
  const Source source = read_source(arguments.source);
  const SourceSurface surface = source ? SourceSurface{&source->first, &source->second} : SourceSurface{};
  const ArrayFormat format = arguments.form == Form::kNpz ? ArrayFormat::kNpz : ArrayFormat::kPng16;
  write_arrays(arguments.output, format, image, maps, source ? &surface : nullptr, console.progress());
}

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  StageClock clock;
  clock.begin("export");
  const GeometryImage image = read_input(arguments.input, FileKind::kGeometryImage, "export", read_geometry_image);
  QualityReport report;
  report.input = arguments.input;
  report.patches = patch_facts(image);
  if (arguments.form == Form::kAsset) {
    const AssetFacts facts = export_with_source(arguments, image, read_maps_for_asset(arguments, image));
    if (!facts.note.empty()) console.note(arguments.input, facts.note);
    report.asset = asset_quality(facts);
  } else {
    export_arrays(arguments, image, console);
  }
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input, "The geometry image that `lozenge pack` wrote");
  options.output(arguments.output, "The asset, a .glb; with --as npz a .npz, with --as png16 a .json");
  options.choice(
      "--as NAME", arguments.form, Words<Form>{{"glb", Form::kAsset}, {"npz", Form::kNpz}, {"png16", Form::kPng16}},
      "glb, the asset; or all samples, maps and tables as data: npz, arrays for NumPy; png16, pictures of 16 "
      "bits beside a JSON; with --source also where samples lie on it [glb]");
  options.group("Asset");
  options.texts("--map FILE", arguments.maps, "Maps that `lozenge bake` wrote for this level of detail").names_inputs();
  options
      .text("--source FILE", arguments.source,
            "The map that the geometry image was sampled from, a .map.glb: the source level needs it, "
            "and what moves; of --as npz, sources of samples")
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
