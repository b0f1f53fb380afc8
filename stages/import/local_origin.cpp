#include "stages/import/local_origin.h"

#include <algorithm>
#include <cmath>

#include "formats/surface/placement.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

namespace {

using Imath::M44d;

/// A surface this many times its size away from the origin has six bits fewer than at it; no prop in a room is.
constexpr double kFar = 64;

struct Box {
  Vec3d low{INFINITY, INFINITY, INFINITY};
  Vec3d high{-INFINITY, -INFINITY, -INFINITY};

  void extend(const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  double diagonal() const { return (high - low).length(); }
  /// Whether it is a box, and lies far off.
  bool is_far() const {
    double most = 0;
    for (int axis = 0; axis < 3; ++axis) most = std::max({most, std::abs(low[axis]), std::abs(high[axis])});
    return std::isfinite(most) && std::isfinite(diagonal()) && most > kFar * diagonal();
  }
};

void extend(Box& box, const Bounds& bounds, const M44d& transform) {
  for (int corner = 0; corner < 8; ++corner) {
    box.extend(placed(transform, Vec3d((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                                       (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                                       (corner & 4) != 0 ? bounds.high.z : bounds.low.z)));
  }
}

/// \param exactly  whether what files say of their bounds is no matter
Box box_of(const InputAsset& asset, const std::vector<M44d>& standing, const std::vector<std::vector<M44d>>& joints,
           bool exactly) {
  Box box;
  for (const InputInstance& instance : asset.instances) {
    const auto count = static_cast<int>(asset.meshes[instance.mesh].primitives.size());
    for (int p = 0; p < count; ++p) {
      const Bounds bounds = asset.extent(instance.mesh, p, exactly);
      if (instance.skin >= 0) {
        for (const M44d& joint : joints[instance.skin]) extend(box, bounds, joint);
      } else {
        const bool is_at_node = instance.mover >= 0 && !instance.is_one_of_many;
        extend(box, bounds, is_at_node ? standing[instance.mover] : instance.transform);
      }
    }
  }
  return box;
}

}  // namespace

Vec3d local_origin(const InputAsset& asset, const std::vector<M44d>& standing,
                   const std::vector<std::vector<M44d>>& joints) {
  const Vec3d none(0, 0, 0);
  if (!asset.extent || !box_of(asset, standing, joints, false).is_far()) return none;
  const Box box = box_of(asset, standing, joints, true);
  if (!box.is_far()) return none;
  const Vec3d middle = (box.low + box.high) / 2;
  const M44d& first = asset.instances.front().transform;
  const Vec3d put(first[3][0], first[3][1], first[3][2]);
  if ((put - middle).length() <= box.diagonal()) return put;
  // A round number, so that what is stored of it is exact.
  const double step = std::exp2(std::ceil(std::log2(std::max(box.diagonal(), 1e-30))));
  return {std::round(middle.x / step) * step, std::round(middle.y / step) * step, std::round(middle.z / step) * step};
}

}  // namespace lozenge
