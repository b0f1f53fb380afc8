// A bend that the level has because it is coarse is spread over whole triangles of the source; a crease is all in the
// edge. So the source is asked close to it, on both sides.
#include "stages/export/corner_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "formats/base/disjoint_sets.h"
#include "formats/base/parallel.h"
#include "stages/export/charted_edges.h"

namespace lozenge {
namespace {

/// Cosine: an edge that bends less needs no question.
constexpr double kFlat = 0.906;  // 25 degrees
/// The source's normals on both sides differ by this angle at least, and by this share of what the level bends by. Of a
/// ball's, so close to the edge, it is a quarter.
constexpr double kLeastJump = 20 * std::numbers::pi / 180;
constexpr double kJumpShare = 0.5;
/// How far into a triangle it is asked, by its height.
constexpr double kInside = 0.08;

/// Both sides of an edge that two triangles share, which run along it in opposite ways.
struct SharedEdge {
  ChartedSide left;
  ChartedSide right;
};

int after(int corner) { return (corner + 1) % 3; }

std::vector<SharedEdge> shared_edges(const ChartedSurface& surface) {
  std::vector<SharedEdge> edges;
  for_each_edge(sides_by_edge(surface), [&](std::span<const ChartedSide> sides) {
    if (sides.size() == 2) edges.push_back({sides[0], sides[1]});
  });
  return edges;
}

class CornerNormals {
 public:
  CornerNormals(const ChartedSurface& level, const ChartedSurface& source, const RayScene& scene)
      : level_(level), source_(source), scene_(scene), smooth_(3 * static_cast<std::int32_t>(level.triangles.size())) {
    for (std::size_t t = 0; t < level.triangles.size(); ++t) faces_.push_back(face(static_cast<TriangleId>(t)));
    join_smooth_corners();
  }

  /// [3 * triangle + corner]
  std::vector<Vec3f> normals(std::span<const ShadedPlace> places) {
    std::vector<Vec3d> own(3 * faces_.size(), Vec3d(0, 0, 0));
    for (std::size_t i = 0; i < own.size(); ++i) own[root(i)] += faces_[i / 3];
    std::vector<Vec3d> sums(own.size(), Vec3d(0, 0, 0));
    std::vector<double> areas(own.size(), 0.0);
    for (const ShadedPlace& place : places) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t corner = root(3 * static_cast<std::size_t>(place.triangle) + static_cast<std::size_t>(c));
        const double weight = place.area * std::max(0.0F, place.weights[c]);
        sums[corner] += Vec3d(place.normal) * weight;
        areas[corner] += weight;
      }
    }
    std::vector<Vec3f> made(own.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
      const std::size_t at = root(i);
      made[i] = at == i ? without_negative_zeros(Vec3f(chosen(own[i], sums[i], areas[i]))) : made[at];
    }
    return made;
  }

 private:
  static Vec3d chosen(Vec3d own, const Vec3d& sum, double area) {
    constexpr double kCancelled = 0.3;
    constexpr double kOtherWay = 0.5;  // cosine
    const double length = own.length();
    if (length > 0) own /= length;
    const double mean = sum.length();
    const bool usable = mean > kCancelled * area && (!(length > 0) || sum.dot(own) > kOtherWay * mean);
    if (usable) return sum / mean;
    return length > 0 ? own : Vec3d(0, 0, 1);
  }

  std::size_t root(std::size_t corner) {
    return static_cast<std::size_t>(smooth_.root(static_cast<std::int32_t>(corner)));
  }

  Vec3d position(TriangleId t, int corner) const {
    return Vec3d(level_.positions[level_.triangles[t].corners[corner].vertex]);
  }

  /// As long as twice its area.
  Vec3d face(TriangleId t) const { return (position(t, 1) - position(t, 0)).cross(position(t, 2) - position(t, 0)); }

  void join_smooth_corners() {
    const std::vector<SharedEdge> edges = shared_edges(level_);
    std::vector<std::uint8_t> is_crease(edges.size(), 0);
    for_each_index(edges.size(), true, [&](std::size_t e) { is_crease[e] = crease(edges[e]) ? 1 : 0; });
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (is_crease[e] != 0) continue;
      const auto corner = [](const ChartedSide& side, int c) { return 3 * side.triangle + c; };
      const auto [left, right] = std::pair(edges[e].left, edges[e].right);
      smooth_.join(corner(left, left.corner), corner(right, after(right.corner)));
      smooth_.join(corner(left, after(left.corner)), corner(right, right.corner));
    }
  }

  bool crease(const SharedEdge& edge) const {
    const Vec3d left = faces_[edge.left.triangle].normalized();
    const Vec3d right = faces_[edge.right.triangle].normalized();
    const double bend = left.dot(right);
    if (bend > kFlat) return false;
    const Vec3d shading_left = shading_beside(edge.left);
    const Vec3d shading_right = shading_beside(edge.right);
    if (!(shading_left.length() > 0) || !(shading_right.length() > 0)) return false;
    const double jump = std::acos(std::clamp(shading_left.dot(shading_right), -1.0, 1.0));
    return jump > kLeastJump && jump > kJumpShare * std::acos(std::clamp(bend, -1.0, 1.0));
  }

  /// The source's, close to an edge in one of its triangles; 0 where the source faces another way there.
  Vec3d shading_beside(const ChartedSide& side) const {
    const Vec3d a = position(side.triangle, side.corner);
    const Vec3d b = position(side.triangle, after(side.corner));
    const Vec3d far = position(side.triangle, after(after(side.corner)));
    Vec3d sum(0, 0, 0);
    for (const double along : {0.25, 0.5, 0.75}) {
      const Vec3d at = (a * (1 - along) + b * along) * (1 - kInside) + far * kInside;
      const NearestPoint near = scene_.nearest(at);
      if (!near.exists()) continue;
      const ChartedTriangle& t = source_.triangles[near.triangle];
      Vec3d normal(0, 0, 0);
      for (int c = 0; c < 3; ++c) normal += Vec3d(t.corners[c].carried) * near.weights[c];
      if (normal.dot(faces_[side.triangle]) > 0) sum += normal.normalized();
    }
    return sum.normalized();
  }

  const ChartedSurface& level_;
  const ChartedSurface& source_;
  const RayScene& scene_;
  std::vector<Vec3d> faces_;           ///< [triangle]
  DisjointSets<std::int32_t> smooth_;  ///< corners with one normal
};

}  // namespace

void set_corner_normals(ChartedSurface& level, std::span<const ShadedPlace> places, const ChartedSurface& source,
                        const RayScene& scene) {
  const std::vector<Vec3f> normals = CornerNormals(level, source, scene).normals(places);
  for (std::size_t t = 0; t < level.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) level.triangles[t].corners[c].carried = normals[3 * t + c];
  }
}

}  // namespace lozenge
