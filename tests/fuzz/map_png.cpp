// The reader of baked maps, stored as PNG.
#include "formats/files/baked_maps_file.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "map.png",
                              [](const std::filesystem::path& file) { lozenge::read_map(file); });
  return 0;
}
