// An exported asset at a time of one of its animations.
#pragma once

#include "formats/files/asset_file.h"
#include "formats/surface/pose.h"

namespace lozenge {

/// The asset with all that stands at rest where it is in the pose: what shows its levels in their places
/// (asset_places.h) shows them so. \param name  how messages call it
/// \throws Error(kUsage) where it has no such animation
Asset in_pose(Asset asset, const Pose& pose, const std::string& name);

}  // namespace lozenge
