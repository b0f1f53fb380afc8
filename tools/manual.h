// Manual pages and the completion of bash, written from what `--help` is written from.
#pragma once

#include <string>

#include "tools/command.h"

namespace lozenge {

/// lozenge.1: the list of commands.
std::string manual_of_program(const ProgramHelp& program, const std::vector<Command>& commands);
/// lozenge-COMMAND.1: what the command does and takes.
std::string manual_of_command(const ProgramHelp& program, const Command& command);

/// A script for bash-completion: commands, options, and the values of options that take certain words, files or
/// folders.
std::string bash_completion(const ProgramHelp& program, const std::vector<Command>& commands);

}  // namespace lozenge
