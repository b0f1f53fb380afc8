// lozenge parameterize: a surface -> its map onto an abstract domain of equilateral triangles.
#include "stages/parameterize/parameterize.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "formats/base/atomic_file.h"
#include "formats/files/parameterization_file.h"
#include "formats/files/source_mesh_file.h"
#include "pipeline/quality/stage_clock.h"
#include "stages/import/import_surface.h"
#include "stages/import/surface.h"
#include "tools/commands.h"
#include "tools/memory_limit.h"
#include "tools/options.h"
#include "tools/stage_options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  a domain as large as the surface's own triangles, its topology and its shape ask for\n"
    "    lozenge parameterize statue.glb -o statue.map.glb\n"
    "  a domain of exactly 60 triangles\n"
    "    lozenge parameterize statue.mesh.glb -o statue.map.glb --domain-faces 60\n"
    "  how good the map is, for a script\n"
    "    lozenge parameterize statue.mesh.glb -o statue.map.glb --json | jq .distortion.aggregate\n"
    "  how distortion goes with the size of the domain, as a picture\n"
    "    lozenge parameterize statue.mesh.glb -o statue.map.glb --trace trace.json\n"
    "    lozenge render trace.json -o trace.png --style trace";

struct Arguments {
  std::string input;
  std::string output;
  std::string report;
  std::string trace;
  ParameterizeOptions options;
  ImportOptions import;
};

/// What `lozenge render --style trace` draws.
std::string trace_json(const std::vector<TraceRow>& trace) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const TraceRow& row : trace) {
    rows.push_back({{"domain_faces", row.domain_faces},
                    {"area", row.area},
                    {"angle", row.angle},
                    {"aggregate", row.aggregate},
                    {"weighed", row.weighed}});
  }
  return nlohmann::ordered_json{{"trace", rows}}.dump(2) + "\n";
}

/// The surface that `import` wrote; anything else is imported first.
SourceMesh read_surface_to_map(const Arguments& arguments, Console& console, QualityReport& report) {
  if (is_source_mesh_file(arguments.input)) return read_source_mesh(arguments.input);
  ImportReport notes;
  SourceMesh mesh = import_surface(arguments.input, arguments.import, console.progress(), &notes);
  report.repairs = notes.repairs;
  report.instances = InstanceFacts{notes.instances, notes.repeated_instances, notes.copies};
  for (const std::string& line : notes.notes) console.note(arguments.input, line);
  return mesh;
}

ExitCode run(const Arguments& arguments, Console& console) {
  require_writable(arguments.output);
  require_writable(arguments.report);
  require_writable(arguments.trace);
  limit_memory(arguments.import.max_memory);
  StageClock clock;
  clock.begin("parameterize");
  QualityReport report;
  report.input = arguments.input;
  SourceMesh mesh = read_surface_to_map(arguments, console, report);
  report.source = require_manifold(mesh, file_name(arguments.input));
  const ParameterizeResult made = parameterize(std::move(mesh), arguments.options, console.progress());
  report.domain = domain_facts(made.map.domain);
  report.domain->least_triangles = made.least_domain_faces;
  report.domain->asked = {made.asked.least, made.asked.most};
  report.domain->parts_by_first_level = parts_by_first_level(made.map);
  report.distortion = made.distortion;
  write_parameterization(arguments.output, made.surface, made.map);
  if (!arguments.trace.empty()) write_file_whole(arguments.trace, trace_json(made.trace));
  clock.finish(report);
  if (!arguments.report.empty()) write_report(arguments.report, report);
  if (const std::string note = note_on_domain_size(made, arguments.options); !note.empty()) {
    console.note(arguments.input, note);
  }
  console.print(report_lines(report), report_json(report));
  return ExitCode::kDone;
}

/// Vertex numbers, separated by commas or, in a file, by any white space.
std::vector<VertexId> parse_vertices(const std::string& text) {
  std::string list = text;
  if (!text.empty() && text.front() == '@') {
    std::ifstream file(text.substr(1));
    if (!file) throw Error(ExitCode::kUsage, "can't read " + text.substr(1));
    list.assign(std::istreambuf_iterator<char>(file), {});
  }
  for (char& c : list) {
    if (c == ',') c = ' ';
  }
  std::istringstream words(list);
  std::vector<VertexId> vertices;
  for (std::string word; words >> word;) {
    VertexId vertex = -1;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), vertex);
    if (error != std::errc() || end != word.data() + word.size() || vertex < 0) {
      throw Error(ExitCode::kUsage, "'" + word + "' is not the number of a vertex");
    }
    vertices.push_back(vertex);
  }
  return vertices;
}

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input,
                "The surface that `lozenge import` wrote, or any asset: that is imported first");
  options.output(arguments.output, "The surface with its map, a .glb");
  options.report(arguments.report, "Write the numbers of the run to this .json");
  options.text("--trace FILE", arguments.trace, "Write how distortion went while the domain shrank to this .json")
      .wants_work();
  add_parameterize_options(options, arguments.options);
  add_import_options(options, arguments.import);
}

}  // namespace

void add_parameterize_options(Options& options, ParameterizeOptions& map) {
  const auto parse_faces = [&map](const std::string& text) {
    const IntRange range = parse_range(text);
    if (range.first < 4) throw Error(ExitCode::kUsage, "a domain has 4 triangles at least");
    map.min_domain_faces = range.first;
    map.max_domain_faces = range.last;
  };
  const Words<EnergyKind> energies = {{"isometric", EnergyKind::kIsometric},
                                      {"mips", EnergyKind::kMips},
                                      {"symmetric-dirichlet", EnergyKind::kSymmetricDirichlet}};
  options.group("Domain");
  options.parsed("--domain-faces A..B", parse_faces,
                 "Triangles of the abstract domain: the best number in the range. [what the source can be cut along "
                 "without becoming much heavier: 100..200 from 50,000 triangles on, fewer of fewer, 4 of a box]");
  options.choice("--energy NAME", map.energy, energies,
                 "What distortion to minimize: isometric (the paper's), mips, symmetric-dirichlet [isometric]");
  options
      .number("--star-conformality X", map.star_conformality, {0.0, 1.0},
              "How stars of irregular vertices are laid into the plane: 0 keeps areas, 1 keeps angles")
      .shows_default();
  options.parsed(
      "--cones LIST", [&map](const std::string& text) { map.cones = parse_vertices(text); },
      "Vertices of the surface that must be vertices of the domain: 12,77,1034, or @FILE with a number a line");
  options.flag("--partitions", map.partitions_in_turn,
               "Optimize over the three partitions of the domain in turn, as the paper does, not all at once: slower");
  options
      .number("--proxy N", map.proxy_triangles_per_face, {0.0, 1e6},
              "Find the domain on a simplified surface of so many triangles for each of the domain's, fewer where it "
              "has more than 200; 0: on the whole")
      .shows_default();
  options.number("--gamma X", map.gamma, {0.0, 100.0}, "Weight of areas against angles; 3 is the paper's choice")
      .shows_default();
}

Command parameterize_command() {
  return repeatable(make_command<Arguments>(
      {"parameterize", "Map a surface onto equilateral triangles", kStageGroup, kExamples}, declare, run));
}

}  // namespace lozenge
