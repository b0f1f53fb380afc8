// lozenge sample: a parameterized surface -> patches, or a plain remesh.
#include "stages/sample/sample.h"

#include <fmt/format.h>

#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/source_mesh_file.h"
#include "pipeline/quality/stage_clock.h"
#include "stages/sample/remesh.h"
#include "stages/sample/sample_count.h"
#include "tools/command_input.h"
#include "tools/commands.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  a grid of 33 x 33 samples for each edge of the domain, to pack\n"
    "    lozenge sample statue.map.glb -o statue.patches.exr --samples 33\n"
    "  a plain, nearly regular triangle mesh\n"
    "    lozenge sample statue.map.glb -o remesh.glb --partition faces --rate 16";

struct Arguments {
  std::string input;
  std::string output;
  SampleOptions options;
  std::optional<Partition> partition;  ///< of a plain mesh, instead of patches
  std::int32_t rate = RemeshOptions().rate;
};

/// The plain mesh instead of patches.
void write_remesh(const Arguments& arguments, const SourceMesh& mesh, const Parameterization& map, Console& console,
                  QualityReport& report) {
  const SourceMesh made = remesh(mesh, map, {*arguments.partition, arguments.rate}, console.progress());
  write_source_mesh(arguments.output, made);
  report.asset.emplace();
  report.asset->triangles = static_cast<std::int64_t>(made.triangles.size());
  report.asset->vertices = static_cast<std::int64_t>(made.positions.size());
}

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  StageClock clock;
  clock.begin("sample");
  QualityReport report;
  report.input = arguments.input;
  const auto [mesh, map] = read_input(arguments.input, FileKind::kParameterization, "sample", read_parameterization);
  report.domain = domain_facts(map.domain);
  if (arguments.partition) {
    write_remesh(arguments, mesh, map, console, report);
  } else {
    const PatchSet patches = sample(mesh, map, arguments.options, console.progress());
    write_patch_set(arguments.output, patches);
    report.patches = patch_facts(patches);
  }
  clock.finish(report);
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  const Words<Partition> partitions = {
      {"faces", Partition::kFaces}, {"half-diamonds", Partition::kHalfDiamonds}, {"half-stars", Partition::kHalfStars}};
  options.input("input", arguments.input, "What `lozenge parameterize` wrote");
  options.output(arguments.output, "The patches, an .exr; with --partition, a mesh, a .glb");
  add_sample_options(options, arguments.options);
  options.group("A plain mesh");
  options
      .choice("--partition NAME", arguments.partition, partitions,
              "Make a plain mesh instead, regular within each: faces, half-diamonds, half-stars")
      .excludes("--samples");
  options.number("--rate N", arguments.rate, {1, kMostRate}, "Steps along a side of each cell of the plain mesh")
      .shows_default()
      .needs("--partition");
}

}  // namespace

void add_sample_options(Options& options, SampleOptions& sample) {
  options.group("Geometry");
  options.samples(
      "--samples N", sample.samples,
      fmt::format("Samples a side of each patch of the geometry image, 2^k + 1 (default: as many as --error "
                  "asks for, up to {})",
                  kMostChosenSamples));
  options
      .number("--error P", sample.error, {0, 100},
              "Distance to the source that is good enough: root mean square, in percent of its box's diagonal")
      .shows_default()
      .excludes("--samples");
}

Command sample_command() {
  return repeatable(make_command<Arguments>(
      {"sample", "Resample a parameterized surface regularly", kStageGroup, kExamples}, declare, run));
}

}  // namespace lozenge
