// The reader of OBJ, given any bytes.
#include "formats/files/readers/obj.h"

#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_input(data, size, "mesh.obj", lozenge::read_obj);
  return 0;
}
