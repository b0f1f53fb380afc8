// A program of ours: one command line, from its arguments to its exit code.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "tools/commands.h"
#include "tools/recall.h"

namespace lozenge {

/// The program that has all commands: `lozenge-whole`, beside the one that runs in a build folder, in
/// PREFIX/libexec/lozenge once installed.
std::filesystem::path builder_program();

/// What help says beside the commands.
ProgramHelp program_help();

/// Where commands run.
struct Workplace {
  /// Keeps the libraries that ThreadLimit doesn't know, because not every program has them, to so many threads.
  void (*limit_threads)(int threads) = nullptr;
  /// The program that does the work: what it made is not taken for what another one would make.
  std::filesystem::path worker = this_program();
};

/// What a program offers.
struct Program {
  std::vector<Command (*)()> commands;  ///< as its help lists them
  void (*limit_threads)(int threads) = nullptr;
};

/// \param command  as a user writes it
bool offers(const Program& program, std::string_view command);

/// \return the exit code of the process (see ExitCode; 128 + signal where it was interrupted); nothing is thrown
int run_program(const Program& program, int argc, const char* const* argv);
/// The same of commands that are there already.
int run_commands(const std::vector<Command>& commands, const Workplace& place, int argc, const char* const* argv);

}  // namespace lozenge
