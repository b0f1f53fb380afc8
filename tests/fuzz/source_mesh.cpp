// The reader of source meshes.
#include "formats/files/source_mesh_file.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "mesh.glb",
                              [](const std::filesystem::path& file) { lozenge::read_source_mesh(file); });
  return 0;
}
