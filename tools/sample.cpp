// lozenge sample: a parameterized surface -> patches, or a plain remesh.
#include "stages/sample/sample.h"

#include <CLI/CLI.hpp>

#include "formats/files/parameterization_file.h"
#include "formats/files/patch_set_file.h"
#include "formats/files/source_mesh_file.h"
#include "pipeline/stage_clock.h"
#include "stages/sample/remesh.h"
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
  RemeshOptions remesh;
  bool wants_remesh = false;
};

const std::map<std::string, Partition> kPartitions = {
    {"faces", Partition::kFaces}, {"half-diamonds", Partition::kHalfDiamonds}, {"half-stars", Partition::kHalfStars}};

/// The plain mesh instead of patches.
void write_remesh(const Arguments& arguments, const SourceMesh& mesh, const Parameterization& map, Console& console,
                  QualityReport& report) {
  const SourceMesh made = remesh(mesh, map, arguments.remesh, console.progress());
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
  const auto [mesh, map] = read_parameterization(arguments.input);
  report.domain = domain_facts(map.domain);
  if (arguments.wants_remesh) {
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

}  // namespace

void add_sample_options(CLI::App& command, SampleOptions& options) {
  add_samples(command, "--samples", options.samples, "Samples a side of each patch of the geometry image, 2^k + 1")
      ->capture_default_str()
      ->group("Geometry");
}

void add_sample_command(CLI::App& app, Request& request) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      add_command(app, request, {"sample", "Resample a parameterized surface regularly", kStageGroup, kExamples},
                  [arguments](Console& console) { return run(*arguments, console); });
  add_input(*command, "input", arguments->input, "What `lozenge parameterize` wrote");
  add_output(*command, arguments->output, "The patches, an .exr; with --partition, a mesh, a .glb");
  add_sample_options(*command, arguments->options);
  CLI::Option* samples = command->get_option("--samples");
  CLI::Option* partition = command
                               ->add_option_function<Partition>(
                                   "--partition",
                                   [arguments](const Partition& value) {
                                     arguments->remesh.partition = value;
                                     arguments->wants_remesh = true;
                                   },
                                   "Make a plain mesh instead, regular within each: faces, half-diamonds, half-stars")
                               ->transform(CLI::CheckedTransformer(kPartitions).description(""))
                               ->type_name("NAME")
                               ->excludes(samples)
                               ->group("A plain mesh");
  command->add_option("--rate", arguments->remesh.rate, "Steps along a side of each cell of the plain mesh")
      ->check(CLI::Range(1, kMostRate).description(""))
      ->type_name("N")
      ->capture_default_str()
      ->needs(partition)
      ->group("A plain mesh");
}

}  // namespace lozenge
