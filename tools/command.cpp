#include "tools/command.h"

#include <CLI/CLI.hpp>

namespace lozenge {

CLI::App* add_command(CLI::App& app, Request& request, const CommandHelp& help,
                      std::function<ExitCode(Console&)> action) {
  CLI::App* command = app.add_subcommand(help.name, help.summary)->group(help.group);
  command->footer("Examples\n" + help.examples);
  command->callback([&request, name = help.name, action = std::move(action)] {
    request.command = name;
    request.action = action;
  });
  return command;
}

void add_common_options(CLI::App& command, CommonOptions& common) {
  constexpr const char* kGroup = "As in every command";
  command.add_option("--threads", common.threads, "At most this many threads; without it, one for each core")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N")
      ->group(kGroup);
  command.add_flag("--json", common.json, "Results as JSON")->group(kGroup);
  command.add_flag("-q,--quiet", common.quiet, "Nothing on stderr but what is wrong")->group(kGroup);
  command.set_help_flag();  // it was the first of all options, and shall be the last
  command.set_help_flag("-h,--help", "Print this")->group(kGroup);
}

}  // namespace lozenge
