// The reader of an OBJ's materials, given any bytes.
#include "formats/files/readers/mtl.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "mesh.mtl", [](const std::filesystem::path& file) {
    lozenge::read_mtl(file.parent_path(), {file.filename().string()}, {"stone", "moss"}, {.max_memory = 500'000'000});
  });
  return 0;
}
