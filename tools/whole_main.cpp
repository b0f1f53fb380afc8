// The program `lozenge-whole`: all commands.
#include "formats/files/openimageio.h"
#include "tools/program.h"

namespace {

void limit_image_threads(int threads) {
  OIIO::attribute("threads", threads);
  OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);  // -1: none but the caller's
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lozenge;
  const Program whole{{add_build_command, add_import_command, add_parameterize_command, add_sample_command,
                       add_pack_command, add_bake_command, add_export_command, add_check_command, add_compare_command,
                       add_info_command, add_render_command},
                      limit_image_threads};
  return run_program(whole, argc, argv);
}
