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
inline constexpr const char* kPipelineGroup = "Pipelines";

class Recall;

struct Command {
  CommandHelp help;
  std::function<void(Options&)> declare;           ///< its options
  std::function<ExitCode(Console&, Recall&)> run;  ///< does the work, with what its options were parsed into
  /// Whether its outputs follow from its inputs and options, so that they can be taken from a cache; and whether it
  /// sees to that itself.
  bool is_repeatable = false;
  bool recalls_by_itself = false;
};

/// \param declare  says which option is parsed into which of the arguments
template <typename Arguments>
Command make_command(const CommandHelp& help, void (*declare)(Options&, Arguments&),
                     ExitCode (*run)(const Arguments&, Console&)) {
  const auto arguments = std::make_shared<Arguments>();
  return {help, [=](Options& options) { declare(options, *arguments); },
          [=](Console& console, Recall&) { return run(*arguments, console); }};
}

/// One whose outputs follow from its inputs and options. They are at the place that -o names, or begin with its name.
inline Command repeatable(Command command) {
  command.is_repeatable = true;
  return command;
}

/// The same, of one that asks the cache itself.
template <typename Arguments>
Command make_recalling_command(const CommandHelp& help, void (*declare)(Options&, Arguments&),
                               ExitCode (*run)(const Arguments&, Console&, Recall&)) {
  const auto arguments = std::make_shared<Arguments>();
  return {help, [=](Options& options) { declare(options, *arguments); },
          [=](Console& console, Recall& recall) { return run(*arguments, console, recall); }, true, true};
}

}  // namespace lozenge
