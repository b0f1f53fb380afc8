// The reader of finished assets.
#include "formats/files/asset_file.h"

#include "formats/files/asset_places.h"
#include "formats/files/asset_pose.h"

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lozenge::fuzz::read_as_file(data, size, "asset.glb", [](const std::filesystem::path& file) {
    const lozenge::Asset asset = lozenge::read_asset(file);
    for (const lozenge::Pose& pose : lozenge::sample_poses(asset.rig, 2, 1)) {
      const lozenge::Asset posed = lozenge::in_pose(asset, pose, "asset.glb");
      for (const lozenge::AssetLevel& level : posed.levels) lozenge::at_rest(level);
    }
  });
  return 0;
}
