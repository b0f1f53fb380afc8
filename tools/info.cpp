// lozenge info: what a file holds.
#include "stages/info/info.h"

#include "tools/commands.h"

namespace lozenge {
namespace {

constexpr const char* kExamples =
    "  what is in a file\n"
    "    lozenge info statue.gim.exr\n"
    "  the same for a script\n"
    "    lozenge info statue.glb --json";

struct Arguments {
  std::string file;
};

ExitCode run(const Arguments& arguments, Console& console) {
  const FileInfo info = describe_file(arguments.file);
  console.print(info.lines, info.json);
  return ExitCode::kDone;
}

void declare(Options& options, Arguments& arguments) {
  options.input("file", arguments.file, "Any glTF, and any file that Lozenge wrote");
}

}  // namespace

Command info_command() {
  return make_command<Arguments>({"info", "Tell what a file holds", kLookGroup, kExamples}, declare, run);
}

}  // namespace lozenge
