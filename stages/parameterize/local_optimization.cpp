#include "stages/parameterize/local_optimization.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stages/parameterize/wedge.h"

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void make_wedges(const WorkingMap& map, const Ring& ring, double scale, Wedges& wedges) {
  wedges.clear();
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Halfedge h = ring.halfedges[i];
    wedges.push_back(make_wedge(map.rest[h / 3], h % 3, ring.at[i], ring.at[i + 1 == n ? 0 : i + 1], scale));
  }
}

thread_local Wedges wedges_of_vertex;

/// Puts `v` at `to`, a point of the frame it is at home in, moving it to another home where that lies outside.
/// \return false, with nothing changed, where the ring can't be seen from there or folds
bool move_vertex(WorkingMap& map, VertexId v, const Vec2d& to, RelaxScratch& scratch) {
  const auto b = barycentrics(to);
  const DomainTriangleId home = map.home[v];
  const Vec2d at = map.at[v];
  if (b[0] >= 0 && b[1] >= 0 && b[2] >= 0) {
    map.at[v] = to;
    if (!scratch.ring.reaches_far || is_sound(map, v)) return true;
    map.at[v] = at;
    return false;
  }
  const auto walked = walk(map.domain, home, at, to);
  if (!walked) return false;
  set_home(map, v, walked->home, walked->at);
  if (is_sound(map, v)) return true;
  set_home(map, v, home, at);
  return false;
}

}  // namespace

std::vector<Vec2d> kernel_of(const std::vector<Vec2d>& ring) {
  // The bounding box, cut by every side's half-plane in turn.
  Vec2d low = ring[0], high = ring[0];
  for (const Vec2d& p : ring) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::vector<Vec2d> kernel{low, {high.x, low.y}, high, {low.x, high.y}};
  std::vector<Vec2d> cut;
  for (std::size_t i = 0; i < ring.size() && !kernel.empty(); ++i) {
    const Vec2d p = ring[i];
    const Vec2d side = ring[i + 1 == ring.size() ? 0 : i + 1] - p;
    cut.clear();
    for (std::size_t j = 0; j < kernel.size(); ++j) {
      const Vec2d a = kernel[j];
      const Vec2d b = kernel[j + 1 == kernel.size() ? 0 : j + 1];
      const double inside_a = cross(side, a - p);
      const double inside_b = cross(side, b - p);
      if (inside_a >= 0) cut.push_back(a);
      if ((inside_a > 0 && inside_b < 0) || (inside_a < 0 && inside_b > 0)) {
        cut.push_back(a + (b - a) * (inside_a / (inside_a - inside_b)));
      }
    }
    kernel.swap(cut);
  }
  if (kernel.size() < 3) kernel.clear();
  return kernel;
}

std::optional<Vec2d> point_of_kernel(const std::vector<Vec2d>& ring) {
  const std::vector<Vec2d> kernel = kernel_of(ring);
  if (kernel.empty()) return std::nullopt;
  Vec2d sum(0, 0);
  for (const Vec2d& p : kernel) sum += p;
  return sum / static_cast<double>(kernel.size());
}

double relax_vertex(WorkingMap& map, VertexId v, RelaxScratch& scratch) {
  if (map.pin[v] >= 0) return 0;
  const Vec2d x = map.at[v];
  if (!gather_ring(map, v, map.home[v], x, scratch.ring)) return 0;
  Wedges& wedges = wedges_of_vertex;
  make_wedges(map, scratch.ring, map.scale(), wedges);
  const double before = energy_at(map.energy, wedges, x);
  if (!(before < kInfinity)) return 0;
  scratch.excess += before;
  for (const Wedge& w : wedges) scratch.excess -= w.share;
  Vec2d step = newton_step(map.energy, wedges, x);
  for (int halving = 0; halving < 6; ++halving, step *= 0.5) {
    const double after = energy_at(map.energy, wedges, x + step);
    if (!(after < before)) continue;
    if (move_vertex(map, v, x + step, scratch)) return before - after;
  }
  return 0;
}

double relax(WorkingMap& map, const std::vector<VertexId>& vertices, const RelaxOptions& options) {
  RelaxScratch scratch;
  double fallen = 0;
  for (int sweep = 0; sweep < options.most_sweeps; ++sweep) {
    double gain = 0;
    scratch.excess = 0;
    if (sweep % 2 == 0) {
      for (const VertexId v : vertices) gain += relax_vertex(map, v, scratch);
    } else {
      for (auto v = vertices.rbegin(); v != vertices.rend(); ++v) gain += relax_vertex(map, *v, scratch);
    }
    fallen += gain;
    // A triangle is visited from each of its corners.
    if (gain <= options.tolerance * scratch.excess / 3) break;
  }
  return fallen;
}

bool heal_folds(WorkingMap& map, const std::vector<VertexId>& vertices) {
  constexpr int kRounds = 8;
  RelaxScratch scratch;
  bool folded = true;
  for (int round = 0; round < kRounds && folded; ++round) {
    folded = false;
    for (const VertexId v : vertices) {
      if (is_sound(map, v)) continue;
      folded = true;
      if (map.pin[v] >= 0 || !gather_ring(map, v, map.home[v], map.at[v], scratch.ring)) continue;
      Vec2d mean(0, 0);
      for (const Vec2d& p : scratch.ring.at) mean += p / static_cast<double>(scratch.ring.size());
      const Vec2d to = point_of_kernel(scratch.ring.at).value_or(mean);
      if (const auto walked = walk(map.domain, map.home[v], map.at[v], to)) set_home(map, v, walked->home, walked->at);
    }
  }
  if (!folded) return true;
  return std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) { return is_sound(map, v); });
}

void move_into_kernels(WorkingMap& map, const std::vector<VertexId>& vertices) {
  RelaxScratch scratch;
  for (const VertexId v : vertices) {
    if (map.pin[v] >= 0 || !gather_ring(map, v, map.home[v], map.at[v], scratch.ring)) continue;
    if (const auto middle = point_of_kernel(scratch.ring.at)) move_vertex(map, v, *middle, scratch);
  }
}

}  // namespace lozenge
