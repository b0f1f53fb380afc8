// The reader of finished assets.
#include "formats/files/asset_file.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "asset.glb",
                              [](const std::filesystem::path& file) { lozenge::read_asset(file); });
  return 0;
}
