// lozenge import: any asset -> one welded surface.
#include "stages/import/import_surface.h"

#include "formats/files/source_mesh_file.h"
#include "pipeline/quality/quality_report.h"
#include "pipeline/quality/stage_clock.h"
#include "stages/import/surface.h"
#include "tools/commands.h"
#include "tools/memory_limit.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  weld an asset into one surface, and repair what is no manifold\n"
    "    lozenge import statue.gltf -o statue.mesh.glb\n"
    "    lozenge import scan.ply -o scan.mesh.glb\n"
    "  fill holes up to a tenth of the asset's size around; refuse an asset that needs any repair\n"
    "    lozenge import scan.glb -o scan.mesh.glb --fill-holes 10\n"
    "    lozenge import cube.glb -o cube.mesh.glb --strict\n"
    "  only see whether Lozenge can take it, and what it is\n"
    "    lozenge import statue.gltf -o statue.mesh.glb --json\n"
    "  an asset that a stranger uploaded\n"
    "    lozenge import upload.glb -o mesh.glb --max-triangles 5000000 --max-memory 4G";

struct Arguments {
  std::string input;
  std::string output;
  ImportOptions options;
};

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  limit_memory(arguments.options.max_memory);
  StageClock clock;
  clock.begin("import");
  ImportReport notes;
  const SourceMesh mesh = import_surface(arguments.input, arguments.options, console.progress(), &notes);
  QualityReport report;
  report.input = arguments.input;
  report.repairs = notes.repairs;
  report.instances = InstanceFacts{notes.instances, notes.repeated_instances, notes.copies};
  report.source = require_manifold(mesh, file_name(arguments.input));
  write_source_mesh(arguments.output, mesh);
  for (const std::string& line : notes.notes) console.note(arguments.input, line);
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input, "The asset: glTF, PLY, OBJ, STL or OFF");
  options.output(arguments.output, "The surface, a .glb that any viewer opens");
  add_import_options(options, arguments.options);
}

}  // namespace

void add_import_options(Options& options, ImportOptions& import) {
  options.group("Repair");
  options.number("--fill-holes PERCENT", import.fill_holes, {0.0, 1e9},
                 "Fill holes of at most this length around, in percent of the box diagonal; 0: none (2)");
  options.flag("--strict", import.strict,
               "Refuse an asset that deviates from its format or whose surface needs repair, instead of mending it");
  options.group("Instances");
  options.choice("--instances HOW", import.instances,
                 Words<Instances>{{"shared", Instances::kShared}, {"separate", Instances::kSeparate}},
                 "Meshes that are placed more than once: shared, one surface that the asset shows in all places where "
                 "it touches nothing else, or separate, each with a surface and maps of its own (shared)");
  options.group("Skins");
  options.one_of(
      "--influences N", import.joints, {4, 8},
      "Joints that move a vertex of a skin at most, the heaviest: 4, or 8 for engines that take as many (4)");
  options.group("Limits");
  // 3 half-edges of a triangle are numbered by 31 bits.
  options.number("--max-triangles N", import.max_triangles, {1, 700'000'000},
                 "Refuse an asset of more triangles, counting every instance (100000000)");
  options
      .bytes("--max-memory SIZE", import.max_memory,
             "Refuse what would take more memory than this, such as 500M or 8G; without it, all there is")
      .doesnt_matter();
}

Command import_command() {
  return repeatable(make_command<Arguments>(
      {"import", "Join everything in an asset into one surface, and repair it", kStageGroup, kExamples}, declare, run));
}

}  // namespace lozenge
