// write_manual FOLDER: writes the manual pages (man1/) and the completion of bash (lozenge) there. Run by the build.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "tools/commands.h"
#include "tools/manual.h"
#include "tools/program.h"

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  stream << text;
  stream.close();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lozenge;
  if (argc != 2) return static_cast<int>(ExitCode::kUsage);
  const std::filesystem::path folder(argv[1]);
  try {
    std::filesystem::create_directories(folder / "man1");
    std::vector<Command> commands;
    for (const auto make : all_commands()) commands.push_back(make());
    const ProgramHelp help = program_help();
    write(folder / "man1/lozenge.1", manual_of_program(help, commands));
    for (const Command& command : commands) {
      write(folder / fmt::format("man1/lozenge-{}.1", command.help.name), manual_of_command(help, command));
    }
    write(folder / "lozenge", bash_completion(help, commands));
  } catch (const std::exception& error) {
    fmt::print(stderr, "write_manual: {}: {}\n", folder.string(), error.what());
    return 1;
  }
  return 0;
}
