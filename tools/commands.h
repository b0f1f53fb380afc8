// The commands of `lozenge`, each in the file of its name.
#pragma once

#include "tools/command.h"

namespace lozenge {

void add_build_command(CLI::App& app, Request& request);

void add_import_command(CLI::App& app, Request& request);
void add_parameterize_command(CLI::App& app, Request& request);
void add_sample_command(CLI::App& app, Request& request);
void add_pack_command(CLI::App& app, Request& request);
void add_bake_command(CLI::App& app, Request& request);
void add_export_command(CLI::App& app, Request& request);

void add_check_command(CLI::App& app, Request& request);
void add_compare_command(CLI::App& app, Request& request);
void add_info_command(CLI::App& app, Request& request);
void add_render_command(CLI::App& app, Request& request);

}  // namespace lozenge
