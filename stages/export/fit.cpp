// Places of the source are found in the level's triangles patch by patch; the normal equations of all of them are
// solved by conjugate gradients, which need nothing but products with each place's own few numbers.
#include "stages/export/fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "formats/surface/turned_triangles.h"
#include "stages/export/charted_scene.h"
#include "stages/export/corner_normals.h"
#include "stages/export/fit_samples.h"

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

/// The least squares of all samples over the moves of the vertices.
class LeastSquares {
 public:
  LeastSquares(const std::vector<FitSample>& samples, std::size_t vertices) : samples_(samples), vertices_(vertices) {}

  std::vector<Vec3d> moves(const std::vector<Vec3f>& positions) const {
    std::vector<Vec3d> x(vertices_, Vec3d(0, 0, 0));
    std::vector<Vec3d> r(vertices_, Vec3d(0, 0, 0));
    std::vector<double> scale(vertices_, 0.0);
    for (const FitSample& s : samples_) {
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
  static Vec3d weighed(const FitSample& s, const Vec3d& d) {
    const Vec3d normal(s.normal);
    return (normal * (normal.dot(d) * (1 - kAcross)) + d * kAcross) * s.area;
  }

  std::vector<Vec3d> product(const std::vector<Vec3d>& x, const std::vector<double>& kept) const {
    std::vector<Vec3d> y = scaled(x, kept);
    for (const FitSample& s : samples_) {
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

  const std::vector<FitSample>& samples_;
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
  std::vector<FitSample> samples = samples_of_source(places, level, patches);
  SamplesOfLevel of_level = samples_of_level(level, source, scene, patches);
  samples.insert(samples.end(), of_level.samples.begin(), of_level.samples.end());
  const LeastSquares fit(samples, level.positions.size());
  const std::vector<Vec3d> wanted = fit.moves(level.positions);
  Moves moves(level, wanted);
  moves.take_back_turns();
  moves.take_back_folds();
  level.positions = moves.made();
  set_corner_normals(level, of_level.shaded, source, scene);
}

}  // namespace lozenge
