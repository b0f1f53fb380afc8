// A command of `lozenge`: what its help says, its options and its work.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "formats/base/error.h"
#include "tools/command_line.h"
#include "tools/console.h"

namespace lozenge {

/// The text of a command's help, but for its options.
struct CommandHelp {
  std::string name;
  std::string summary;   ///< one line, without a full stop
  std::string group;     ///< of commands, in the list of all
  std::string examples;  ///< for each: a line that says what for, a line with the command
};

inline constexpr const char* kWholeGroup = "From an asset to an asset";
inline constexpr const char* kStageGroup = "The same, one stage at a time";
inline constexpr const char* kLookGroup = "Looking at what came out";

struct Command {
  CommandHelp help;
  std::function<void(Options&)> declare;  ///< its options
  std::function<ExitCode(Console&)> run;  ///< does the work, with what its options were parsed into
};

/// \param declare  says which option is parsed into which of the arguments
template <typename Arguments>
Command make_command(const CommandHelp& help, void (*declare)(Options&, Arguments&),
                     ExitCode (*run)(const Arguments&, Console&)) {
  const auto arguments = std::make_shared<Arguments>();
  return {help, [=](Options& options) { declare(options, *arguments); },
          [=](Console& console) { return run(*arguments, console); }};
}

}  // namespace lozenge
