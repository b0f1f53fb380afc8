// The importer, given any glTF, of either container; repair and hole filling included.
#include "stages/import/import_surface.h"

#include "formats/surface/pose.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "asset.glb", [](const std::filesystem::path& file) {
    const lozenge::SourceMesh mesh =
        lozenge::import_surface(file, {.max_triangles = 100'000, .max_memory = 500'000'000, .fill_holes = 100});
    for (const lozenge::Pose& pose : lozenge::sample_poses(mesh.rig, 2, 1)) lozenge::in_pose(mesh, pose);
  });
  return 0;
}
