// The commands of `lozenge`, each in the file of its name.
#pragma once

#include <vector>

#include "tools/command.h"

namespace lozenge {

Command build_command();
Command unwrap_command();

Command import_command();
Command parameterize_command();
Command sample_command();
Command pack_command();
Command bake_command();
Command export_command();

Command check_command();
Command compare_command();
Command info_command();
Command render_command();

Command batch_command();
Command cache_command();

/// All of them, as help lists them.
std::vector<Command (*)()> all_commands();

}  // namespace lozenge
