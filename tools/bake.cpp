// lozenge bake: a parameterized surface and its geometry image -> texture maps.
#include "stages/bake/bake.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "formats/files/geometry_image_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/texture_files.h"
#include "pipeline/maps/map_files.h"
#include "pipeline/maps/map_size.h"
#include "pipeline/output_set.h"
#include "pipeline/quality/stage_clock.h"
#include "stages/export/export.h"
#include "tools/command_input.h"
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

/// Writes all maps or none, as FOLDER/NAME.normal.png for the output FOLDER/NAME.
void write_together(const std::filesystem::path& output, const BakedMaps& maps, const PatchLayout& patches,
                    const MapFiles& files) {
  if (!output.has_filename())
    throw Error(ExitCode::kUsage, "-o: ends in a folder; add the name that the maps begin with");
  OutputSet outputs(output.has_parent_path() ? output.parent_path() : ".");
  const std::string name = output.filename().string();
  const BakedMaps stored = write_maps(outputs.staging_folder(), name, maps, files);
  write_mips(outputs.staging_folder(), name, stored, patches, files);
  outputs.commit();
}

ExitCode run(const Arguments& arguments, Console& console) {
  StageClock clock;
  clock.begin("bake");
  const auto [mesh, map] = read_input(arguments.map, FileKind::kParameterization, "bake", read_parameterization);
  const GeometryImage image = read_input(arguments.image, FileKind::kGeometryImage, "bake", read_geometry_image);
  BakeOptions options = with_map_size(arguments.options, mesh, image.layout);
  options.level = level_to_export(image, arguments.level);
  const TextureFiles textures(mesh, texture_roles(options, mesh), {}, console.progress());
  for (const std::string& note : textures.notes()) console.note(arguments.map, note);
  const BakedMaps maps = bake(mesh, map, image, options, console.progress(), &textures);
  for (const std::string& note : {note_on_occlusion_pose(options, maps, mesh), note_on_occlusion(maps.statistics)}) {
    if (!note.empty()) console.note(arguments.map, note);
  }
  write_together(arguments.output, maps, image.layout, arguments.files);
  QualityReport report;
  report.input = arguments.map;
  report.patches = patch_facts(image);
  report.bake = maps.statistics;
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("source", arguments.map, "The parameterized source that `lozenge parameterize` wrote");
  options.input("image", arguments.image, "The geometry image that `lozenge pack` made of it");
  options.output(arguments.output, "What the names of the maps begin with, as out/statue");
  add_level_options(options, "--samples", arguments.level);
  add_bake_options(options, arguments.options, arguments.files);
}

}  // namespace

Command bake_command() {
  return repeatable(make_command<Arguments>(
      {"bake", "Take texture maps over from the source surface", kStageGroup, kExamples}, declare, run));
}

}  // namespace lozenge
