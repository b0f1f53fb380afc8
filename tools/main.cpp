// The program `lozenge`. The stages from a surface to its patches run here. For everything else the process becomes
// `lozenge-whole`, which is linked with OpenImageIO and Embree: these bring 250 shared libraries, 130 MB of memory and
// a fifth of a second of loading, that the parameterization of a mesh should not pay.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include "formats/base/error.h"
#include "tools/build_arguments.h"
#include "tools/program.h"

namespace lozenge {
namespace {

const Program kSurfaces{
    {import_command, parameterize_command, sample_command, pack_command, batch_command, cache_command}};

/// Without the cache nothing is taken from it, and the other program parses the command line.
bool names_a_cache(int argc, char** argv) {
  return std::getenv("LOZENGE_CACHE") != nullptr ||
         std::any_of(argv, argv + argc, [](std::string_view word) { return word.starts_with("--cache"); });
}

/// `build` from the cache alone. \return the exit code; nothing where there is more to do
std::optional<int> recall_whole_build(int argc, char** argv) {
  if (argc < 2 || argv[1] != std::string_view("build") || !names_a_cache(argc, argv)) return std::nullopt;
  return run_recalled_build(builder_program(), argc, argv);
}

/// \return only where it can't
int become_whole(char** argv) {
  const std::filesystem::path program = builder_program();
  execv(program.c_str(), argv);
  fmt::print(stderr, "lozenge: can't start {}: {}; install Lozenge as a whole, or build it again\n", program.string(),
             std::generic_category().message(errno));
  return static_cast<int>(ExitCode::kInternal);
}

}  // namespace
}  // namespace lozenge

int main(int argc, char** argv) {
  using namespace lozenge;
  if (argc > 1 && offers(kSurfaces, argv[1])) return run_program(kSurfaces, argc, argv);
  if (const std::optional<int> done = recall_whole_build(argc, argv)) return *done;
  return become_whole(argv);
}
