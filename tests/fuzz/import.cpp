// The importer, given any glTF, of either container.
#include "stages/import/import.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "asset.glb", [](const std::filesystem::path& file) {
    lozenge::import_gltf(file, {.max_triangles = 100'000, .max_memory = 500'000'000});
  });
  return 0;
}
