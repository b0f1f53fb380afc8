// Where a level shows each place where the source does, the atlas says what corresponds; elsewhere the nearest point
// does that is of the same part and faces the same way.
#include "stages/export/fit_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "formats/base/parallel.h"
#include "formats/patches/triangle_tile.h"
#include "stages/export/charted_scene.h"

namespace lozenge {
namespace {

/// A triangle in space.
struct Face {
  std::array<Vec3d, 3> corners;
  Vec3d cross;  ///< along its normal, as long as twice its area

  Face(const ChartedSurface& surface, const ChartedTriangle& t) {
    for (int k = 0; k < 3; ++k) corners[k] = Vec3d(surface.positions[t.corners[k].vertex]);
    cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  }
  double area() const { return cross.length() / 2; }
  Vec3d at(const Vec3d& weights) const {
    return corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
  }
};

std::array<VertexId, 3> vertices_of(const ChartedTriangle& t) {
  return {t.corners[0].vertex, t.corners[1].vertex, t.corners[2].vertex};
}

/// A point of the level.
struct Counterpart {
  TriangleId triangle = -1;  ///< -1 where there is none
  Vec3d weights{0, 0, 0};
};

/// The triangles of one patch of the level, in a grid over its square.
class PatchTriangles {
 public:
  PatchTriangles(const ChartedSurface& level, std::vector<std::int32_t> triangles)
      : level_(level), triangles_(std::move(triangles)) {
    side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(triangles_.size()) / 2)), 1, 64);
    cells_.resize(static_cast<std::size_t>(side_) * side_);
    for (const std::int32_t t : triangles_) {
      const auto& c = level.triangles[t].corners;
      const auto [left, right] = std::minmax({c[0].place.x, c[1].place.x, c[2].place.x});
      const auto [top, bottom] = std::minmax({c[0].place.y, c[1].place.y, c[2].place.y});
      for (int y = cell(top); y <= cell(bottom); ++y) {
        for (int x = cell(left); x <= cell(right); ++x) cells_[y * side_ + x].push_back(t);
      }
    }
  }

  /// The triangle that holds a place, or is nearest to do so.
  Counterpart find(const Vec2d& place) const {
    Counterpart best;
    double deepest = -std::numeric_limits<double>::infinity();
    const auto look = [&](const std::vector<std::int32_t>& list) {
      for (const std::int32_t t : list) {
        const Vec3d w = weights_in(level_.triangles[t], place);
        const double depth = std::min({w.x, w.y, w.z});
        if (!(depth > deepest)) continue;
        deepest = depth;
        best = {t, w};
      }
    };
    look(cells_[cell(place.y) * side_ + cell(place.x)]);
    constexpr double kOutside = -0.05;
    if (deepest < kOutside) look(triangles_);
    return best;
  }

 private:
  int cell(double x) const { return std::clamp(static_cast<int>(x * side_), 0, side_ - 1); }

  static Vec3d weights_in(const ChartedTriangle& t, const Vec2d& at) {
    const Vec2d& a = t.corners[0].place;
    const Vec2d& b = t.corners[1].place;
    const Vec2d& c = t.corners[2].place;
    const double whole = (b - a).cross(c - a);
    if (!(whole > 0)) return {-1e30, -1e30, -1e30};
    return Vec3d((b - at).cross(c - at), (c - at).cross(a - at), (a - at).cross(b - at)) / whole;
  }

  const ChartedSurface& level_;
  std::vector<std::int32_t> triangles_;
  int side_ = 1;
  std::vector<std::vector<std::int32_t>> cells_;
};

/// `visit(weights, share)` for places spread over a triangle, each with its share of the area: the middles of n * n
/// equal triangles, of no more than `step` a side in the atlas.
template <typename Visit>
void for_each_place(const ChartedTriangle& t, double step, const Visit& visit) {
  constexpr int kMost = 24;
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    longest = std::max(longest, (t.corners[(k + 1) % 3].place - t.corners[k].place).length());
  }
  const int n = std::clamp(static_cast<int>(std::ceil(longest / step)), 1, kMost);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2 * (n - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const double b = (i + third) / n;
      const double c = (j / 2 + third) / n;
      visit(Vec3d(1 - b - c, b, c), 1.0 / (n * n));
    }
  }
}

/// Places of a triangle of the source with their counterparts. \param counterpart  of a place in the atlas and in space
template <typename Find>
void add_samples(const ChartedTriangle& t, const Face& face, const ChartedSurface& level, double step,
                 const Find& counterpart, std::vector<FitSample>& samples) {
  const double area = face.area();
  if (!(area > 0)) return;
  const Vec3f normal(face.cross.normalized());
  for_each_place(t, step, [&](const Vec3d& w, double share) {
    const Vec2d place = t.corners[0].place * w.x + t.corners[1].place * w.y + t.corners[2].place * w.z;
    const Vec3d position = face.at(w);
    const Counterpart there = counterpart(place, position);
    if (there.triangle < 0) return;
    samples.push_back({vertices_of(level.triangles[there.triangle]), Vec3f(there.weights), normal, Vec3f(position),
                       static_cast<float>(area * share)});
  });
}

/// The triangles that a place may be held against: of the same part, and facing the same way.
class Counterparts {
 public:
  /// Keeps references. \param scene  of the surface's triangles
  Counterparts(const ChartedSurface& surface, const RayScene& scene, const std::vector<std::int32_t>& parts)
      : surface_(surface), scene_(scene), parts_(parts) {}

  /// \param close  a triangle that is near, where one is known; becomes the nearest of all
  NearestPoint nearest(const Vec3d& position, const Vec3d& normal, std::int32_t patch, TriangleId& close) const {
    // Who faces no way would be held against each triangle of the surface, and against none in the end.
    if (!(normal.length2() > 0)) return {};
    const auto counts = [&](TriangleId t) {
      const ChartedTriangle& other = surface_.triangles[t];
      return parts_[other.patch] == parts_[patch] && Face(surface_, other).cross.dot(normal) > 0;
    };
    // The nearest of all is one that counts nearly always, and found without asking on the way.
    const NearestPoint any = scene_.nearest_from(close, position);
    close = any.triangle;
    return !any.exists() || counts(any.triangle) ? any : scene_.nearest_of(counts, position);
  }

 private:
  const ChartedSurface& surface_;
  const RayScene& scene_;
  const std::vector<std::int32_t>& parts_;
};

std::vector<FitSample> joined(std::vector<std::vector<FitSample>>& lists) {
  std::size_t count = 0;
  for (const auto& list : lists) count += list.size();
  std::vector<FitSample> all;
  all.reserve(count);
  for (auto& list : lists) {
    all.insert(all.end(), list.begin(), list.end());
    std::vector<FitSample>().swap(list);
  }
  return all;
}

}  // namespace

std::vector<FitSample> samples_of_source(const ChartedSurface& source, const ChartedSurface& level,
                                         const FitPatches& patches) {
  constexpr double kStep = 0.75;         // by a side of the level's triangles
  constexpr double kNearestStep = 0.25;  // slipped patches have few
  const auto count = static_cast<std::int32_t>(patches.parts.size());
  const auto of_source = triangles_by_patch(source, count);
  const auto of_level = triangles_by_patch(level, count);
  const RayScene scene = scene_of(level);
  const Counterparts counterparts(level, scene, patches.parts);
  std::vector<std::vector<FitSample>> lists(of_source.size());
  for_each_index(of_source.size(), true, [&](std::size_t patch) {
    const bool slipped = patches.slipped[patch];
    if (!slipped && of_level[patch].empty()) return;
    const double step = kStep / std::sqrt(std::max(1.0, static_cast<double>(of_level[patch].size()) / 2));
    const PatchTriangles in(level, of_level[patch]);
    std::vector<FitSample>& samples = lists[patch];
    TriangleId close = -1;
    for (const std::int32_t t : of_source[patch]) {
      const std::size_t first = samples.size();
      const ChartedTriangle& triangle = source.triangles[t];
      const Face face(source, triangle);
      const auto nearest = [&](const Vec2d&, const Vec3d& position) -> Counterpart {
        const NearestPoint there = counterparts.nearest(position, face.cross, triangle.patch, close);
        return {there.triangle, there.weights};
      };
      const auto in_atlas = [&](const Vec2d& place, const Vec3d&) { return in.find(place); };
      if (slipped) add_samples(triangle, face, level, std::min(kNearestStep, step), nearest, samples);
      else add_samples(triangle, face, level, step, in_atlas, samples);
      if (patches.importance.empty()) continue;
      for (std::size_t i = first; i < samples.size(); ++i) samples[i].area *= patches.importance[t];
    }
  });
  return joined(lists);
}

SamplesOfLevel samples_of_level(const ChartedSurface& level, const ChartedSurface& source, const RayScene& scene,
                                const FitPatches& patches) {
  constexpr int kPoints = 4;
  constexpr double kFar = 2.0 / 3;
  const std::array<Vec3d, kPoints> weights{Vec3d(1, 1, 1) / 3, Vec3d(kFar, (1 - kFar) / 2, (1 - kFar) / 2),
                                           Vec3d((1 - kFar) / 2, kFar, (1 - kFar) / 2),
                                           Vec3d((1 - kFar) / 2, (1 - kFar) / 2, kFar)};
  const Counterparts counterparts(source, scene, patches.parts);
  SamplesOfLevel found;
  found.samples.resize(kPoints * level.triangles.size());
  found.shaded.resize(found.samples.size());
  for_each_index(level.triangles.size(), true, [&](std::size_t t) {
    const ChartedTriangle& triangle = level.triangles[t];
    const Face face(level, triangle);
    TriangleId close = -1;
    for (std::size_t n = 0; n < weights.size(); ++n) {
      const NearestPoint there = counterparts.nearest(face.at(weights[n]), face.cross, triangle.patch, close);
      if (!there.exists()) continue;
      const ChartedTriangle& near = source.triangles[there.triangle];
      Vec3d carried(0, 0, 0);
      for (int k = 0; k < 3; ++k) carried += Vec3d(near.corners[k].carried) * there.weights[k];
      const FitSample s{vertices_of(triangle), Vec3f(weights[n]), Vec3f(Face(source, near).cross.normalized()),
                        Vec3f(there.point), static_cast<float>(face.area() / kPoints)};
      found.samples[kPoints * t + n] = s;
      found.shaded[kPoints * t + n] = {static_cast<TriangleId>(t), s.weights, Vec3f(carried), s.area};
    }
  });
  std::erase_if(found.samples, [](const FitSample& s) { return !(s.area > 0); });
  std::erase_if(found.shaded, [](const ShadedPlace& place) { return !(place.area > 0); });
  return found;
}

}  // namespace lozenge
