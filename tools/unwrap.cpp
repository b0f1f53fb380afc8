// lozenge unwrap: texture coordinates for an asset that stays what it is otherwise.
#include "pipeline/unwrap/unwrap.h"

#include "formats/base/atomic_file.h"
#include "pipeline/quality/stage_clock.h"
#include "tools/command_input.h"
#include "tools/commands.h"
#include "tools/memory_limit.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  texture coordinates for a scan\n"
    "    lozenge unwrap scan.ply -o scan.glb\n"
    "  a second set for light maps; the first one and its textures stay\n"
    "    lozenge unwrap room.glb -o room.lit.glb --uv-set 1 --texels-per-unit 64\n"
    "  an atlas of 4096 texels a side for each mesh of a scene\n"
    "    lozenge unwrap scene.glb -o scene.uv.glb --map-size 4096 --pack-each";

struct Arguments {
  std::string input;
  std::string output;
  UnwrapOptions options;
};

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  limit_memory(arguments.options.import.max_memory);
  const UnwrapResult result = unwrap(arguments.input, arguments.output, arguments.options, console.progress());
  for (const std::string& note : result.notes) console.note(arguments.input, note);
  console.print(unwrap_lines(result), unwrap_json(result));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  UnwrapOptions& unwrap = arguments.options;
  options.input("input", arguments.input, "The asset: glTF, PLY, OBJ, STL or OFF");
  options.output(arguments.output, "The same asset with texture coordinates, a .glb");
  options.group("Atlas");
  options
      .number("--uv-set K", unwrap.uv_set, {0, 7},
              "The set of texture coordinates to write, TEXCOORD_K; one that is there is replaced, all others stay")
      .shows_default();
  options.number("--map-size N", unwrap.map_size, {16, 32768},
                 "Side of the square atlas, in texels [2048, or what its patches need]");
  options.number("--gutter N", unwrap.gutter, {0, 64}, "Texels around each patch that belong to it").shows_default();
  options.number("--texels-per-unit X", unwrap.texels_per_unit, {0.0, 1e9},
                 "Texels to a unit of length of the scene, instead of a size of the atlas");
  options.flag("--pack-each", unwrap.pack_each, "An atlas for each mesh; without it, one for all");
  add_parameterize_options(options, unwrap.parameterize);
  add_import_options(options, unwrap.import);
}

}  // namespace

Command unwrap_command() {
  return repeatable(make_command<Arguments>(
      {"unwrap", "Give an asset texture coordinates, and leave it as it is otherwise", kWholeGroup, kExamples}, declare,
      run));
}

}  // namespace lozenge
