// An edge is part of the outline where one of its triangles faces the eye and the other doesn't. Of all directions to
// look from, along the edge's own apart, that is the share of its bend by pi; the outline's normal is then between
// those of the triangles. So the sum over a thin rod's edges is that of its outlines, however many edges it is made of.
#include "stages/export/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stages/export/charted_edges.h"

namespace lozenge {
namespace {

/// A bend of less shows no outline by itself, radians.
constexpr double kFlat = 0.02;

class OutlineFinder {
 public:
  OutlineFinder(const ChartedSurface& surface, const std::vector<float>& importance, double width)
      : surface_(surface), importance_(importance), width_(width) {}

  /// \param other  null at the surface's end
  void add(const ChartedSide& side, const ChartedSide* other, std::vector<OutlineEdge>& edges) const {
    const Vec3d from = position(side.triangle, side.corner);
    const Vec3d along = position(side.triangle, side.corner + 1) - from;
    const Vec3d normal = normal_of(side.triangle);
    const double length = along.length();
    if (!(length > 0) || normal == Vec3d(0, 0, 0)) return;
    OutlineEdge edge{side.triangle, side.corner, {}, 0};
    double bend = std::numbers::pi;
    const Vec3d axis = along / length;
    if (other != nullptr) {
      const Vec3d apex = position(other->triangle, other->corner + 2);
      const Vec3d beside = normal_of(other->triangle);
      if (beside == Vec3d(0, 0, 0) || normal.dot(apex - from) >= 0) return;  // flat, or a valley
      bend = std::acos(std::clamp(normal.dot(beside), -1.0, 1.0));
      if (bend < kFlat) return;
    }
    // The triangle lies to the left of its side, so the surface bends away to the right.
    const Vec3d out = axis.cross(normal);
    for (int k = 0; k < 3; ++k) {
      const double turn = bend * (2 * k + 1) / 6;
      edge.normals[static_cast<std::size_t>(k)] = normal * std::cos(turn) + out * std::sin(turn);
    }
    const float seen = std::max(importance_[side.triangle], other == nullptr ? 0.0F : importance_[other->triangle]);
    edge.weight = seen * width_ * length * bend / std::numbers::pi;
    edges.push_back(edge);
  }

 private:
  Vec3d position(std::int32_t t, int corner) const {
    return Vec3d(surface_.positions[surface_.triangles[t].corners[corner % 3].vertex]);
  }
  /// Unit; 0 of a triangle without area.
  Vec3d normal_of(std::int32_t t) const {
    const Vec3d p = position(t, 0);
    const Vec3d cross = (position(t, 1) - p).cross(position(t, 2) - p);
    const double length = cross.length();
    return length > 0 ? cross / length : Vec3d(0, 0, 0);
  }

  const ChartedSurface& surface_;
  const std::vector<float>& importance_;
  double width_;
};

}  // namespace

std::vector<OutlineEdge> outline_edges(const ChartedSurface& surface, const std::vector<float>& importance,
                                       double width) {
  const OutlineFinder finder(surface, importance, width);
  std::vector<OutlineEdge> edges;
  for_each_edge(sides_by_edge(surface), [&](std::span<const ChartedSide> sides) {
    if (sides.size() <= 2) finder.add(sides[0], sides.size() == 2 ? &sides[1] : nullptr, edges);
  });
  return edges;
}

}  // namespace lozenge
