// lozenge info: what a file holds.
#include "stages/info/info.h"

#include <CLI/CLI.hpp>

#include "tools/commands.h"
#include "tools/options.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  what is in a file\n"
    "    lozenge info statue.gim.exr\n"
    "  the same for a script\n"
    "    lozenge info statue.glb --json";

}  // namespace

void add_info_command(CLI::App& app, Request& request) {
  const auto file = std::make_shared<std::string>();
  CLI::App* command =
      add_command(app, request, {"info", "Tell what a file holds", kLookGroup, kExamples}, [file](Console& console) {
        const FileInfo info = describe_file(*file);
        console.print(info.lines, info.json);
        return ExitCode::kDone;
      });
  add_input(*command, "file", *file, "Any file that Lozenge wrote");
}

}  // namespace lozenge
