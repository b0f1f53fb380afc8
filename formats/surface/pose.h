// An asset at a time of one of its animations: what its rig is there, and where its surface goes.
#pragma once

#include <Imath/ImathMatrix.h>

#include <string>
#include <vector>

#include "formats/surface/rig.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// A time of an animation.
struct Pose {
  std::int32_t animation = 0;  ///< of those of the rig
  double time = 0;             ///< seconds; before the first key and after the last one nothing moves
};

struct PosedRig {
  Rig rig;  ///< whose rest is the pose
  /// [node] weights of morph targets; none where the animation moves none.
  std::vector<std::vector<double>> weights;
};

/// \param name  how messages call the asset
/// \throws Error(kUsage) where the rig has no such animation
PosedRig posed(const Rig& rig, const Pose& pose, const std::string& name);

/// Times of an animation's first and last key.
struct TimeRange {
  double first = 0;
  double last = 0;
};
TimeRange time_range(const Animation& animation);

/// A few times of each of some animations, spread over all of them: what is moved differs most from what was seen at
/// rest somewhere between the keys. \param animations  at most so many \param times  of each
std::vector<Pose> sample_poses(const Rig& rig, std::size_t animations, std::size_t times);

/// The weights that a body's morph targets have in a pose.
std::vector<double> weights_in(const PosedRig& posed, const Body& body);

/// Whether triangles belong to a skin, and no vertex knows its joints: then there are no poses.
bool lacks_influences(const SourceMesh& mesh);

/// The mesh with each body in its own space, where it was modelled: positions and normals. Where that mirrors,
/// triangles face inward.
SourceMesh as_modelled(const SourceMesh& mesh);

/// The mesh as it stands in a pose: positions, normals, the places of its bodies.
/// \throws Error(kUsage) as above
SourceMesh in_pose(const SourceMesh& mesh, const Pose& pose);

}  // namespace lozenge
