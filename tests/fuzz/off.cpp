// The reader of OFF, given any bytes.
#include "formats/files/readers/off.h"

#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_input(data, size, "mesh.off", lozenge::read_off);
  return 0;
}
