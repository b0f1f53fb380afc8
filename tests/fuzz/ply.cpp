// The reader of PLY, given any bytes.
#include "formats/files/readers/ply.h"

#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_input(data, size, "mesh.ply", lozenge::read_ply);
  return 0;
}
