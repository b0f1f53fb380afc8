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
  const Program whole{all_commands(), limit_image_threads};
  return run_program(whole, argc, argv);
}
