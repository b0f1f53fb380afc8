// The reader of patch sets.
#include "formats/files/patch_set_file.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "patches.exr",
                              [](const std::filesystem::path& file) { lozenge::read_patch_set(file); });
  return 0;
}
