// Collapses and flips, chosen by chance, on a mesh that knows the triangles around each vertex. Each is tried on the
// side: it is done only where the mesh stays a closed manifold, no normal turns far from where it began, no triangle
// becomes a needle, and the surface stays within the tolerance. How far it has moved so far is kept at the vertices, as
// a bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "formats/base/error.h"
#include "stages/import/surface.h"
#include "tools/bench/bench_mesh.h"
#include "tools/bench/random_numbers.h"

namespace lozenge::bench {
namespace {

using Corners = std::array<VertexId, 3>;

/// Least height of a triangle, of its longest side: thin, but far from what rounding could turn around.
constexpr double kLeastHeight = 0.004;
/// Most triangles around a vertex.
constexpr std::size_t kMostValence = 24;
/// Share of the flips that are done although they make the thinner of the two triangles less thin.
constexpr double kFlipsForTheBetter = 0.3;

/// Squared distance from p to the triangle a, b, c.
double squared_distance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto to_segment = [&](const Vec3d& s, const Vec3d& e) {
    const Vec3d along = e - s;
    const double at = std::clamp((p - s).dot(along) / along.length2(), 0.0, 1.0);
    return (p - s - along * at).length2();
  };
  const Vec3d normal = (b - a).cross(c - a);
  const bool above = (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                     (a - c).cross(p - c).dot(normal) >= 0;
  if (above) return std::pow((p - a).dot(normal), 2) / normal.length2();
  return std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
}

class Retriangulation {
 public:
  Retriangulation(const Surface& mesh, const UnevenOptions& options)
      : triangles_(mesh.triangles),
        alive_(mesh.triangles.size(), true),
        around_(mesh.positions.size()),
        moved_(mesh.positions.size(), 0),
        least_cosine_(std::cos(options.most_turn * std::numbers::pi / 180)),
        tolerance_(options.tolerance * diagonal(bounds_of(mesh.positions))) {
    for (const Vec3f& p : mesh.positions) positions_.emplace_back(p);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (const VertexId v : triangles_[t]) around_[v].push_back(static_cast<TriangleId>(t));
      began_.push_back(normal_of(triangles_[t]).normalized());
    }
  }

  /// Moves the end of a random edge at `v`, and all that hangs on it, to the other end. \return whether it was done
  bool collapse(VertexId v, RandomNumbers& random);
  /// Flips a random edge at `v`. \return whether it was done
  bool flip(VertexId v, RandomNumbers& random);

  Surface finish(const Surface& mesh) const;

 private:
  Vec3d normal_of(const Corners& t) const {
    return (positions_[t[1]] - positions_[t[0]]).cross(positions_[t[2]] - positions_[t[0]]);
  }
  /// Height of a triangle on its longest side, of that side.
  double relative_height(const Corners& t) const;
  bool is_sound(const Corners& t, const Vec3d& began) const;
  /// The side of a triangle that leaves `v` for a random neighbour.
  std::pair<TriangleId, int> random_side(VertexId v, RandomNumbers& random) const;
  std::vector<VertexId> ring(VertexId v) const;
  /// The triangle with the side from a to b, or -1.
  TriangleId triangle_at(VertexId a, VertexId b) const;
  VertexId opposite(TriangleId t, VertexId a, VertexId b) const;
  /// Squared distance from v to what its star becomes when it moves to u, or nothing where a triangle wouldn't be
  /// sound.
  std::optional<double> distance_after(VertexId v, VertexId u) const;
  void detach(TriangleId t, VertexId v) { std::erase(around_[v], t); }

  std::vector<Vec3d> positions_;
  std::vector<Corners> triangles_;
  std::vector<bool> alive_;                      ///< [triangle]
  std::vector<std::vector<TriangleId>> around_;  ///< [vertex]
  std::vector<Vec3d> began_;                     ///< [triangle] unit normal that its own may not turn far from
  std::vector<double> moved_;                    ///< [vertex] about how far the surface around it has moved at most
  double least_cosine_;
  double tolerance_;
};

double Retriangulation::relative_height(const Corners& t) const {
  double longest = 0;
  for (int s = 0; s < 3; ++s) {
    longest = std::max(longest, (positions_[t[(s + 1) % 3]] - positions_[t[s]]).length2());
  }
  return normal_of(t).length() / longest;
}

bool Retriangulation::is_sound(const Corners& t, const Vec3d& began) const {
  const Vec3d normal = normal_of(t);
  return relative_height(t) > kLeastHeight && normal.dot(began) >= least_cosine_ * normal.length();
}

std::pair<TriangleId, int> Retriangulation::random_side(VertexId v, RandomNumbers& random) const {
  const TriangleId t = around_[v][random.below(static_cast<std::int32_t>(around_[v].size()))];
  return {t, static_cast<int>(std::find(triangles_[t].begin(), triangles_[t].end(), v) - triangles_[t].begin())};
}

std::vector<VertexId> Retriangulation::ring(VertexId v) const {
  std::vector<VertexId> vertices;
  for (const TriangleId t : around_[v]) {
    const int s = static_cast<int>(std::find(triangles_[t].begin(), triangles_[t].end(), v) - triangles_[t].begin());
    vertices.push_back(triangles_[t][(s + 1) % 3]);
  }
  return vertices;
}

TriangleId Retriangulation::triangle_at(VertexId a, VertexId b) const {
  for (const TriangleId t : around_[a]) {
    for (int s = 0; s < 3; ++s) {
      if (triangles_[t][s] == a && triangles_[t][(s + 1) % 3] == b) return t;
    }
  }
  return -1;
}

VertexId Retriangulation::opposite(TriangleId t, VertexId a, VertexId b) const {
  for (const VertexId v : triangles_[t]) {
    if (v != a && v != b) return v;
  }
  return -1;
}

std::optional<double> Retriangulation::distance_after(VertexId v, VertexId u) const {
  std::optional<double> nearest;
  for (const TriangleId t : around_[v]) {
    Corners moved = triangles_[t];
    if (std::find(moved.begin(), moved.end(), u) != moved.end()) continue;
    std::replace(moved.begin(), moved.end(), v, u);
    if (!is_sound(moved, began_[t])) return std::nullopt;
    const double d = squared_distance(positions_[v], positions_[moved[0]], positions_[moved[1]], positions_[moved[2]]);
    if (!nearest || d < *nearest) nearest = d;
  }
  return nearest;
}

bool Retriangulation::collapse(VertexId v, RandomNumbers& random) {
  const auto [left, side] = random_side(v, random);
  const VertexId u = triangles_[left][(side + 1) % 3];
  const TriangleId right = triangle_at(u, v);
  const VertexId c = opposite(left, u, v);
  const VertexId d = opposite(right, u, v);
  if (around_[c].size() <= 3 || around_[d].size() <= 3) return false;
  if (around_[v].size() + around_[u].size() - 4 > kMostValence) return false;
  const std::vector<VertexId> ring_of_u = ring(u);
  // Elsewhere the two would be joined by a third vertex, and the surface pinched there.
  const auto shared = [&](VertexId w) { return std::find(ring_of_u.begin(), ring_of_u.end(), w) != ring_of_u.end(); };
  if (std::ranges::count_if(ring(v), shared) != 2) return false;
  const std::optional<double> squared = distance_after(v, u);
  if (!squared) return false;
  const double moved = std::max(moved_[v], moved_[u]) + std::sqrt(*squared);
  if (moved > tolerance_) return false;

  for (const TriangleId t : {left, right}) {
    for (const VertexId w : triangles_[t]) {
      if (w != v) detach(t, w);
    }
    alive_[t] = false;
  }
  for (const TriangleId t : around_[v]) {
    if (!alive_[t]) continue;
    std::replace(triangles_[t].begin(), triangles_[t].end(), v, u);
    around_[u].push_back(t);
  }
  around_[v].clear();
  moved_[u] = moved;
  return true;
}

bool Retriangulation::flip(VertexId v, RandomNumbers& random) {
  const auto [left, side] = random_side(v, random);
  const VertexId u = triangles_[left][(side + 1) % 3];
  const TriangleId right = triangle_at(u, v);
  const VertexId c = opposite(left, u, v);
  const VertexId d = opposite(right, u, v);
  if (around_[u].size() <= 3 || around_[v].size() <= 3) return false;
  if (around_[c].size() >= kMostValence || around_[d].size() >= kMostValence) return false;
  if (triangle_at(c, d) >= 0 || triangle_at(d, c) >= 0) return false;
  const Corners first{v, d, c};
  const Corners second{d, u, c};
  const Vec3d began = (began_[left] + began_[right]).normalized();
  if (!is_sound(first, began) || !is_sound(second, began)) return false;
  const bool better = std::min(relative_height(first), relative_height(second)) >
                      std::min(relative_height(triangles_[left]), relative_height(triangles_[right]));
  if (better && random.unit() >= kFlipsForTheBetter) return false;
  // Between the two diagonals of the four vertices: the volume of their tetrahedron over the area of its middle.
  const Vec3d across = (positions_[u] - positions_[v]).cross(positions_[d] - positions_[c]);
  const double distance = std::abs(across.dot(positions_[c] - positions_[v])) / across.length();
  const double moved = std::max({moved_[u], moved_[v], moved_[c], moved_[d]}) + distance;
  if (!(moved <= tolerance_)) return false;

  triangles_[left] = first;
  triangles_[right] = second;
  began_[left] = began_[right] = began;
  detach(left, u);
  detach(right, v);
  around_[d].push_back(left);
  around_[c].push_back(right);
  for (const VertexId w : {u, v, c, d}) moved_[w] = moved;
  return true;
}

Surface Retriangulation::finish(const Surface& mesh) const {
  Surface result;
  std::vector<VertexId> numbers(mesh.positions.size(), -1);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (!alive_[t]) continue;
    Corners corners = triangles_[t];
    for (VertexId& v : corners) {
      if (numbers[v] < 0) {
        numbers[v] = static_cast<VertexId>(result.positions.size());
        result.positions.push_back(mesh.positions[v]);
      }
      v = numbers[v];
    }
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

Surface uneven(const Surface& mesh, std::uint64_t seed, const UnevenOptions& options) {
  SourceMesh source;
  source.positions = mesh.positions;
  source.triangles = mesh.triangles;
  if (require_manifold(source, "mesh").boundary_edges > 0) {
    throw Error(ExitCode::kUnsupported, "mesh: is open; only closed surfaces can be made uneven");
  }

  RandomNumbers random(seed);
  Retriangulation work(mesh, options);
  std::vector<VertexId> left(mesh.positions.size());
  for (std::size_t v = 0; v < left.size(); ++v) left[v] = static_cast<VertexId>(v);
  const auto kept = static_cast<std::size_t>(static_cast<double>(left.size()) * (1 - options.removed));
  double flips_due = 0;
  // Where too few can be removed, some tries for each vertex are enough to know.
  for (std::size_t tries = 20 * mesh.positions.size(); tries > 0 && left.size() > kept; --tries) {
    VertexId& v = left[random.below(static_cast<std::int32_t>(left.size()))];
    if (work.collapse(v, random)) {
      v = left.back();
      left.pop_back();
    }
    for (flips_due += options.flips; flips_due >= 1; --flips_due) {
      work.flip(left[random.below(static_cast<std::int32_t>(left.size()))], random);
    }
  }
  return work.finish(mesh);
}

}  // namespace lozenge::bench
