// The reader of STL, given any bytes.
#include "formats/files/readers/stl.h"

#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_input(data, size, "mesh.stl", lozenge::read_stl);
  return 0;
}
