// lozenge check: proves the guarantees of files.
#include "stages/check/check.h"

#include "tools/commands.h"
#include "tools/options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  everything that a build wrote\n"
    "    lozenge check out/statue.glb out/statue.gim.exr out/statue.gim.json out/statue.normal.png\n"
    "  in a script: the exit code is 0 where all guarantees hold\n"
    "    lozenge check --quiet statue.gim.exr && echo sound";

/// One JSON object for one file, an array for several.
std::string joined(const std::vector<std::string>& objects) {
  if (objects.size() == 1) return objects.front();
  std::string text = "[\n";
  for (std::size_t k = 0; k < objects.size(); ++k) text += objects[k] + (k + 1 < objects.size() ? ",\n" : "\n");
  return text + "]";
}

using Arguments = std::vector<std::string>;  // files

ExitCode run(const Arguments& files, Console& console) {
  ExitCode code = ExitCode::kDone;
  std::vector<std::string> lines;
  std::vector<std::string> objects;
  for (const std::string& file : files) {
    const CheckReport report = check_file(file);
    lines.push_back(file + ": " + report.kind);
    for (const std::string& line : report_lines(report)) lines.push_back("  " + line);
    objects.push_back(report_json(report));
    if (!report.passed()) {
      console.complain(file_name(file) + ": a guarantee is broken; see the result");
      if (code == ExitCode::kDone) code = report.code;
    }
  }
  console.print(lines, joined(objects));
  return code;
}

void declare(Options& options, Arguments& files) { options.inputs("files", files, "Any files that Lozenge wrote"); }

}  // namespace

Command check_command() {
  return make_command<Arguments>(
      {"check", "Prove every guarantee of a file, or say which one breaks where", kLookGroup, kExamples}, declare, run);
}

}  // namespace lozenge
