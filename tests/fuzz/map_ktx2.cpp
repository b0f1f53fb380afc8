// The reader of baked maps with their mips.
#include "formats/files/map_mips_file.h"
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "map.ktx2",
                              [](const std::filesystem::path& file) { lozenge::read_map_mips(file); });
  return 0;
}
