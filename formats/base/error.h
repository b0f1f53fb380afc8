// The one exception type of Lozenge, and the exit codes that it carries to the shell.
#pragma once

#include <stdexcept>
#include <string>

namespace lozenge {

/// Exit codes of every command.
enum class ExitCode : int {
  kDone = 0,
  kInternal = 1,       ///< our own fault
  kUsage = 2,          ///< the command line is wrong
  kUnusableInput = 3,  ///< the input is broken: truncated, inconsistent, NaN, empty
  kUnsupported = 4,    ///< the input is sound, but needs what Lozenge doesn't do (yet)
  kLimit = 5,          ///< a limit on size, memory or time was reached
  kSystem = 6,         ///< the system refuses: a full disk, a place that may not be written, a process that can't start
};

/// What a failed call of the system says about whose fault it is: a path that makes no sense was written by the user
/// (kUsage), anything else is the system's refusal (kSystem).
/// \param error  errno
ExitCode code_of_refusal(int error);

/// Anything that an input, an option or the system can cause. The message names the file, what is wrong with it,
/// where, and what to do: "statue.glb: accessor 3 ends 24 bytes past its buffer view; export the file again".
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace lozenge
