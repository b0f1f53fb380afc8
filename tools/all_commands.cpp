#include "tools/commands.h"

namespace lozenge {

std::vector<Command (*)()> all_commands() {
  return {build_command, unwrap_command, import_command, parameterize_command, sample_command,
          pack_command,  bake_command,   export_command, check_command,        compare_command,
          info_command,  render_command, batch_command,  cache_command};
}

}  // namespace lozenge
