// Places of the source are found in the level's triangles patch by patch; the normal equations of all of them are
// solved by conjugate gradients, which need nothing but products with each place's own few numbers.
#include "stages/export/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "formats/base/parallel.h"
#include "formats/surface/turned_triangles.h"
#include "stages/export/charted_scene.h"
#include "stages/export/corner_normals.h"

namespace lozenge {
namespace {

/// Weight of the distance across the normal, against that along it: where the map has vertices matters where nothing
/// else does.
constexpr double kAcross = 0.002;
/// Weight of a vertex's own place, against the distances that it is to mend: moves that gain little stay small. With a
/// third of it the mean distance is a hundredth less, and the largest half again as large.
constexpr double kKept = 1;
constexpr int kMostSteps = 60;
constexpr double kSmallEnough = 1e-4;  ///< residual that ends them, by the first

/// A place of the source, and where the level has it; in floats, for there are many.
struct Sample {
  std::array<VertexId, 3> vertices{-1, -1, -1};
  Vec3f weights;
  Vec3f normal;
  Vec3f position;
  float area = 0;
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

  /// The triangle that holds a place, or is nearest to do so, and the weights of its corners.
  std::int32_t find(const Vec2d& place, Vec3d& weights) const {
    std::int32_t best = -1;
    double deepest = -std::numeric_limits<double>::infinity();
    const auto look = [&](const std::vector<std::int32_t>& list) {
      for (const std::int32_t t : list) {
        const Vec3d w = weights_in(level_.triangles[t], place);
        const double depth = std::min({w.x, w.y, w.z});
        if (!(depth > deepest)) continue;
        deepest = depth;
        best = t;
        weights = w;
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

std::vector<std::vector<std::int32_t>> by_patch(const ChartedSurface& surface) {
  std::vector<std::vector<std::int32_t>> lists;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto patch = static_cast<std::size_t>(surface.triangles[t].patch);
    if (lists.size() <= patch) lists.resize(patch + 1);
    lists[patch].push_back(static_cast<std::int32_t>(t));
  }
  return lists;
}

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

/// Places of a triangle of the source where the level has the same place of the atlas.
void add_samples(const ChartedSurface& source, const ChartedTriangle& t, const PatchTriangles& in,
                 const ChartedSurface& level, double step, std::vector<Sample>& samples) {
  std::array<Vec3d, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = Vec3d(source.positions[t.corners[k].vertex]);
  const Vec3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area = normal.length() / 2;
  if (!(area > 0)) return;
  for_each_place(t, step, [&](const Vec3d& w, double share) {
    Vec2d place(0, 0);
    Vec3d position(0, 0, 0);
    for (int k = 0; k < 3; ++k) {
      place += t.corners[k].place * w[k];
      position += p[k] * w[k];
    }
    Vec3d weights;
    const std::int32_t found = in.find(place, weights);
    if (found < 0) return;
    Sample s;
    s.weights = Vec3f(weights);
    s.position = Vec3f(position);
    for (int k = 0; k < 3; ++k) s.vertices[k] = level.triangles[found].corners[k].vertex;
    s.normal = Vec3f(normal / (2 * area));
    s.area = static_cast<float>(area * share);
    samples.push_back(s);
  });
}

/// The triangles that a place may be held against: of the same part, and facing the same way.
class Counterparts {
 public:
  /// Keeps references. \param scene  of the surface's triangles
  Counterparts(const ChartedSurface& surface, const RayScene& scene, const std::vector<std::int32_t>& parts)
      : surface_(surface), scene_(scene), parts_(parts) {}

  NearestPoint nearest(const Vec3d& position, const Vec3d& normal, std::int32_t patch) const {
    const auto counts = [&](TriangleId t) {
      const ChartedTriangle& other = surface_.triangles[t];
      if (parts_[other.patch] != parts_[patch]) return false;
      const Vec3d a(surface_.positions[other.corners[0].vertex]);
      const Vec3d b(surface_.positions[other.corners[1].vertex]);
      const Vec3d c(surface_.positions[other.corners[2].vertex]);
      return (b - a).cross(c - a).dot(normal) > 0;
    };
    // The nearest of all is one that counts nearly always, and found without asking on the way.
    const NearestPoint any = scene_.nearest(position);
    return !any.exists() || counts(any.triangle) ? any : scene_.nearest_of(counts, position);
  }

 private:
  const ChartedSurface& surface_;
  const RayScene& scene_;
  const std::vector<std::int32_t>& parts_;
};

/// Places of a triangle of the source, each with the level's nearest point.
void add_samples_of_nearest(const ChartedSurface& source, const ChartedTriangle& t, const Counterparts& counterparts,
                            const ChartedSurface& level, double step, std::vector<Sample>& samples) {
  std::array<Vec3d, 3> p;
  for (int k = 0; k < 3; ++k) p[k] = Vec3d(source.positions[t.corners[k].vertex]);
  const Vec3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const double area = normal.length() / 2;
  if (!(area > 0)) return;
  for_each_place(t, step, [&](const Vec3d& w, double share) {
    const Vec3d position = p[0] * w.x + p[1] * w.y + p[2] * w.z;
    const NearestPoint there = counterparts.nearest(position, normal, t.patch);
    if (!there.exists()) return;
    Sample s;
    for (int k = 0; k < 3; ++k) s.vertices[k] = level.triangles[there.triangle].corners[k].vertex;
    s.weights = Vec3f(there.weights);
    s.position = Vec3f(position);
    s.normal = Vec3f(normal / (2 * area));
    s.area = static_cast<float>(area * share);
    samples.push_back(s);
  });
}

std::vector<Sample> joined(std::vector<std::vector<Sample>>& lists) {
  std::size_t count = 0;
  for (const auto& list : lists) count += list.size();
  std::vector<Sample> all;
  all.reserve(count);
  for (auto& list : lists) {
    all.insert(all.end(), list.begin(), list.end());
    std::vector<Sample>().swap(list);
  }
  return all;
}

/// Places of the source, each with what it is held against, as `FitPatches` says.
std::vector<Sample> samples_of(const ChartedSurface& source, const ChartedSurface& level, const FitPatches& patches) {
  constexpr double kStep = 0.75;         // by a side of the level's triangles
  constexpr double kNearestStep = 0.25;  // slipped patches have few
  const auto of_source = by_patch(source);
  auto of_level = by_patch(level);
  of_level.resize(std::max(of_source.size(), of_level.size()));
  const RayScene scene = scene_of(level);
  const Counterparts counterparts(level, scene, patches.parts);
  std::vector<std::vector<Sample>> lists(of_source.size());
  for_each_index(of_source.size(), true, [&](std::size_t patch) {
    const bool slipped = patches.slipped[patch];
    if (!slipped && of_level[patch].empty()) return;
    const double step = kStep / std::sqrt(std::max(1.0, static_cast<double>(of_level[patch].size()) / 2));
    const PatchTriangles in(level, of_level[patch]);
    std::vector<Sample>& samples = lists[patch];
    for (const std::int32_t t : of_source[patch]) {
      const std::size_t first = samples.size();
      const ChartedTriangle& triangle = source.triangles[t];
      if (slipped) add_samples_of_nearest(source, triangle, counterparts, level, std::min(kNearestStep, step), samples);
      else add_samples(source, triangle, in, level, step, samples);
      if (patches.importance.empty()) continue;
      for (std::size_t i = first; i < samples.size(); ++i) samples[i].area *= patches.importance[t];
    }
  });
  return joined(lists);
}

/// Places spread over the level, each with the source's nearest point that faces the same way. \return how they are
/// shaded
std::vector<ShadedPlace> add_nearest(const ChartedSurface& level, const ChartedSurface& source,
                                     const Counterparts& counterparts, std::vector<Sample>& samples) {
  constexpr int kPoints = 4;
  constexpr double kFar = 2.0 / 3;
  const std::array<Vec3d, kPoints> weights{Vec3d(1, 1, 1) / 3, Vec3d(kFar, (1 - kFar) / 2, (1 - kFar) / 2),
                                           Vec3d((1 - kFar) / 2, kFar, (1 - kFar) / 2),
                                           Vec3d((1 - kFar) / 2, (1 - kFar) / 2, kFar)};
  std::vector<Sample> found(kPoints * level.triangles.size());
  std::vector<ShadedPlace> shaded(found.size());
  for_each_index(level.triangles.size(), true, [&](std::size_t t) {
    const auto& corners = level.triangles[t].corners;
    std::array<Vec3d, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = Vec3d(level.positions[corners[k].vertex]);
    const Vec3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
    for (int n = 0; n < kPoints; ++n) {
      const Vec3d& w = weights[static_cast<std::size_t>(n)];
      const NearestPoint there =
          counterparts.nearest(p[0] * w.x + p[1] * w.y + p[2] * w.z, cross, level.triangles[t].patch);
      if (!there.exists()) continue;
      const auto& near = source.triangles[there.triangle].corners;
      Sample s;
      std::array<Vec3d, 3> q;
      Vec3d carried(0, 0, 0);
      for (int k = 0; k < 3; ++k) {
        q[k] = Vec3d(source.positions[near[k].vertex]);
        s.vertices[k] = corners[k].vertex;
        carried += Vec3d(near[k].carried) * there.weights[k];
      }
      const Vec3d normal = (q[1] - q[0]).cross(q[2] - q[0]);
      s.weights = Vec3f(w);
      s.normal = Vec3f(normal.normalized());
      s.position = Vec3f(there.point);
      s.area = static_cast<float>(cross.length() / (2 * kPoints));
      found[kPoints * t + static_cast<std::size_t>(n)] = s;
      shaded[kPoints * t + static_cast<std::size_t>(n)] = {static_cast<TriangleId>(t), s.weights, Vec3f(carried),
                                                           s.area};
    }
  });
  for (const Sample& s : found) {
    if (s.area > 0) samples.push_back(s);
  }
  std::erase_if(shaded, [](const ShadedPlace& place) { return !(place.area > 0); });
  return shaded;
}

/// The least squares of all samples over the moves of the vertices.
class LeastSquares {
 public:
  LeastSquares(const std::vector<Sample>& samples, std::size_t vertices) : samples_(samples), vertices_(vertices) {}

  std::vector<Vec3d> moves(const std::vector<Vec3f>& positions) const {
    std::vector<Vec3d> x(vertices_, Vec3d(0, 0, 0));
    std::vector<Vec3d> r(vertices_, Vec3d(0, 0, 0));
    std::vector<double> scale(vertices_, 0.0);
    for (const Sample& s : samples_) {
      Vec3d at(0, 0, 0);
      for (int k = 0; k < 3; ++k) at += Vec3d(positions[s.vertices[k]]) * s.weights[k];
      const Vec3d pull = weighed(s, Vec3d(s.position) - at);
      for (int k = 0; k < 3; ++k) {
        r[s.vertices[k]] += pull * s.weights[k];
        scale[s.vertices[k]] += s.area * s.weights[k] * s.weights[k];
      }
    }
    std::vector<double> kept(vertices_);
    for (std::size_t v = 0; v < vertices_; ++v) {
      kept[v] = kKept * scale[v];
      scale[v] = scale[v] > 0 ? 1 / (scale[v] + kept[v]) : 0;
    }
    std::vector<Vec3d> z = scaled(r, scale);
    std::vector<Vec3d> p = z;
    double rz = dot(r, z);
    const double enough = rz * kSmallEnough * kSmallEnough;
    for (int step = 0; step < kMostSteps && rz > enough; ++step) {
      const std::vector<Vec3d> ap = product(p, kept);
      const double pap = dot(p, ap);
      if (!(pap > 0)) break;
      const double alpha = rz / pap;
      for (std::size_t v = 0; v < vertices_; ++v) {
        x[v] += p[v] * alpha;
        r[v] -= ap[v] * alpha;
      }
      z = scaled(r, scale);
      const double next = dot(r, z);
      const double beta = next / rz;
      rz = next;
      for (std::size_t v = 0; v < vertices_; ++v) p[v] = z[v] + p[v] * beta;
    }
    return x;
  }

 private:
  static Vec3d weighed(const Sample& s, const Vec3d& d) {
    const Vec3d normal(s.normal);
    return (normal * (normal.dot(d) * (1 - kAcross)) + d * kAcross) * s.area;
  }

  std::vector<Vec3d> product(const std::vector<Vec3d>& x, const std::vector<double>& kept) const {
    std::vector<Vec3d> y = scaled(x, kept);
    for (const Sample& s : samples_) {
      Vec3d at(0, 0, 0);
      for (int k = 0; k < 3; ++k) at += x[s.vertices[k]] * s.weights[k];
      const Vec3d pull = weighed(s, at);
      for (int k = 0; k < 3; ++k) y[s.vertices[k]] += pull * s.weights[k];
    }
    return y;
  }

  static std::vector<Vec3d> scaled(const std::vector<Vec3d>& r, const std::vector<double>& scale) {
    std::vector<Vec3d> z(r.size());
    for (std::size_t v = 0; v < r.size(); ++v) z[v] = r[v] * scale[v];
    return z;
  }
  static double dot(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].dot(b[v]);
    return sum;
  }

  const std::vector<Sample>& samples_;
  std::size_t vertices_;
};

Vec3d normal_of(const ChartedTriangle& t, const std::vector<Vec3d>& positions) {
  const Vec3d& p = positions[t.corners[0].vertex];
  return (positions[t.corners[1].vertex] - p).cross(positions[t.corners[2].vertex] - p);
}

/// The share of each vertex's move that is made.
class Moves {
 public:
  Moves(const ChartedSurface& level, const std::vector<Vec3d>& moves)
      : level_(level),
        moves_(moves),
        before_(level.positions.begin(), level.positions.end()),
        share_(before_.size(), 1.0) {}

  std::vector<Vec3f> made() const {
    std::vector<Vec3f> moved;
    for (std::size_t v = 0; v < before_.size(); ++v) moved.push_back(without_negative_zeros(Vec3f(after(v))));
    return moved;
  }

  /// Takes moves back, by half and half, where they turn a triangle further than by this.
  void take_back_turns() {
    constexpr double kMostTurned = 0.5;  // cosine
    constexpr int kHalvings = 6;
    std::vector<Vec3d> moved(before_.size());
    for (int round = 0; round <= kHalvings; ++round) {
      for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = after(v);
      std::vector<VertexId> turned;
      for (const ChartedTriangle& t : level_.triangles) {
        const Vec3d old = normal_of(t, before_);
        const Vec3d now = normal_of(t, moved);
        if (now.dot(old) > kMostTurned * now.length() * old.length()) continue;
        for (const ChartedCorner& c : t.corners) turned.push_back(c.vertex);
      }
      if (turned.empty()) return;
      std::sort(turned.begin(), turned.end());
      turned.erase(std::unique(turned.begin(), turned.end()), turned.end());
      for (const VertexId v : turned) share_[v] = round + 1 < kHalvings ? share_[v] / 2 : 0;
    }
  }

  /// Takes back what turns triangles against all of their neighbours, though none by so much, and more and more around
  /// them.
  void take_back_folds() {
    constexpr int kMostRounds = 4;
    const std::vector<std::array<VertexId, 3>> triangles = vertices_of(level_);
    std::vector<bool> is_kept(before_.size(), false);
    for (int round = 0; round < kMostRounds; ++round) {
      const std::vector<TriangleId> turned = turned_triangles({made(), triangles});
      if (turned.empty()) return;
      for (const TriangleId t : turned) {
        for (const VertexId v : triangles[t]) is_kept[v] = true;
      }
      const std::vector<bool> seeds = is_kept;
      for (const auto& t : triangles) {
        if (seeds[t[0]] || seeds[t[1]] || seeds[t[2]]) is_kept[t[0]] = is_kept[t[1]] = is_kept[t[2]] = true;
      }
      for (std::size_t v = 0; v < is_kept.size(); ++v) {
        if (is_kept[v]) share_[v] = 0;
      }
    }
  }

 private:
  Vec3d after(std::size_t v) const { return before_[v] + moves_[v] * share_[v]; }

  const ChartedSurface& level_;
  const std::vector<Vec3d>& moves_;
  std::vector<Vec3d> before_;
  std::vector<double> share_;
};

}  // namespace

void fit_to_source(ChartedSurface& level, const ChartedSurface& places, const ChartedSurface& source,
                   const RayScene& scene, const FitPatches& patches) {
  std::vector<Sample> samples = samples_of(places, level, patches);
  const std::vector<ShadedPlace> shaded =
      add_nearest(level, source, Counterparts(source, scene, patches.parts), samples);
  const LeastSquares fit(samples, level.positions.size());
  const std::vector<Vec3d> wanted = fit.moves(level.positions);
  Moves moves(level, wanted);
  moves.take_back_turns();
  moves.take_back_folds();
  level.positions = moves.made();
  set_corner_normals(level, shaded, source, scene);
}

}  // namespace lozenge
