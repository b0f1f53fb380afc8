// The reader of geometry images.
#include "formats/files/geometry_image_file.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "image.gim.exr",
                              [](const std::filesystem::path& file) { lozenge::read_geometry_image(file); });
  return 0;
}
