// A program of ours: one command line, from its arguments to its exit code.
#pragma once

#include <string_view>
#include <vector>

#include "tools/commands.h"

namespace lozenge {

/// What a program offers.
struct Program {
  std::vector<Command (*)()> commands;  ///< as its help lists them
  /// Keeps the libraries that ThreadLimit doesn't know, because not every program has them, to so many threads.
  void (*limit_threads)(int threads) = nullptr;
};

/// \param command  as a user writes it
bool offers(const Program& program, std::string_view command);

/// \return the exit code of the process (see ExitCode; 128 + signal where it was interrupted); nothing is thrown
int run_program(const Program& program, int argc, const char* const* argv);

}  // namespace lozenge
