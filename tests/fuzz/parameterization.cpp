// The reader of parameterizations.
#include "formats/files/parameterization_file.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "map.glb",
                              [](const std::filesystem::path& file) { lozenge::read_parameterization(file); });
  return 0;
}
