#include "formats/files/asset_pose.h"

namespace lozenge {

Asset in_pose(Asset asset, const Pose& pose, const std::string& name) {
  const PosedRig rig = posed(asset.rig, pose, name);
  const std::vector<Imath::M44d> standing = standing_transforms(rig.rig);
  for (AssetLevel& level : asset.levels) {
    for (AssetPart& part : level.parts) {
      for (std::size_t p = 0; p < part.places.size(); ++p) {
        const std::int32_t node = part.nodes[p];
        if (node >= 0 && part.skin < 0) {
          part.places[p] = placement_of(counted_from(asset.translation, standing[node]));
        }
      }
      if (part.skin >= 0) {
        part.joints = standing_joints(rig.rig, static_cast<std::size_t>(part.skin), standing);
        for (Imath::M44d& joint : part.joints) joint = counted_from(asset.translation, joint);
      }
      part.weights = weights_in(rig, {"", {{kUnmoved, part.nodes.front()}}, -1, part.targets});
    }
  }
  asset.rig = rig.rig;
  return asset;
}

}  // namespace lozenge
