#include "tools/command.h"

#include <CLI/CLI.hpp>

namespace lozenge {

CLI::App* add_command(CLI::App& app, Request& request, const CommandHelp& help,
                      std::function<ExitCode(Console&)> action) {
  constexpr const char* kGroup = "As in every command";
  CLI::App* command = app.add_subcommand(help.name, help.summary)->group(help.group);
  command->footer("Examples\n" + help.examples);
  command->set_help_flag("-h,--help", "Print this")->group(kGroup);
  command->add_option("--threads", request.common.threads, "At most this many threads; without it, one for each core")
      ->check(CLI::Range(1, 1024).description(""))
      ->type_name("N")
      ->group(kGroup);
  command->add_flag("--json", request.common.json, "Results as JSON")->group(kGroup);
  command->add_flag("-q,--quiet", request.common.quiet, "Nothing on stderr but what is wrong")->group(kGroup);
  command->callback([&request, name = help.name, action = std::move(action)] {
    request.command = name;
    request.action = action;
  });
  return command;
}

}  // namespace lozenge
