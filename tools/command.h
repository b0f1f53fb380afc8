// What the commands of `lozenge` share: their common options, and how they are run.
#pragma once

#include <functional>
#include <string>

#include "formats/base/error.h"
#include "tools/console.h"

namespace CLI {
class App;
}

namespace lozenge {

/// Options that every command takes.
struct CommonOptions {
  int threads = 0;  ///< 0: one for each core
  bool json = false;
  bool quiet = false;
};

/// What a parsed command line asks for.
struct Request {
  CommonOptions common;
  std::string command;
  /// Does the work of the command that was parsed; set while parsing, run afterwards.
  std::function<ExitCode(Console&)> action;
};

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

/// Adds a command; `action` does its work, with what its options were parsed into.
/// \return the command, to add its own options to
CLI::App* add_command(CLI::App& app, Request& request, const CommandHelp& help,
                      std::function<ExitCode(Console&)> action);

/// Adds what every command takes; after the command's own options, so that help lists it last.
void add_common_options(CLI::App& command, CommonOptions& common);

}  // namespace lozenge
