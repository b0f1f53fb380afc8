// Pictures as assets bring them, decoded for look-ups: given any bytes.
#include <memory>

#include "formats/files/picture_header.h"
#include "formats/files/readers/input_file.h"
#include "formats/files/texture_files.h"
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lozenge;
  fuzz::read_as_file(data, size, "picture", [](const std::filesystem::path& file) {
    InputFile input(file, "picture");
    std::vector<unsigned char> bytes(input.size());
    input.read(bytes.data(), bytes.size());
    if (find_texture_defect(bytes)) return;
    SourceMesh mesh;
    const std::string mime_type(read_picture_header(bytes)->mime_type);
    mesh.images.push_back({"picture", mime_type, std::make_shared<const std::vector<unsigned char>>(std::move(bytes))});
    TextureUse& use = mesh.material_looks.emplace_back().texture(TextureRole::kBaseColour);
    use.image = 0;
    const TextureRole role = TextureRole::kBaseColour;
    const TextureFiles textures(mesh, {&role, 1}, {.max_memory = 100'000'000});
    if (textures.can_look_up(use, role)) textures.look_up(use, role, {{0.5, 0.5}, {0.1, 0}, {0, 0.1}});
  });
  return 0;
}
