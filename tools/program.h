// The program `lozenge`: one command line, from its arguments to its exit code.
#pragma once

namespace lozenge {

/// \return the exit code of the process (see ExitCode; 128 + signal where it was interrupted); nothing is thrown
int run_program(int argc, const char* const* argv);

}  // namespace lozenge
