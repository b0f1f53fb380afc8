// A vertex sees its neighbours in the frame of its home, by the charts, and the triangles around it as wedges whose
// energy is a function of its displacement alone. A free vertex of the boundary moves along its side. Where a step ends
// outside of the home, the vertex walks into another one and takes its charts along.
#include "stages/parameterize/relax/local_optimization.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/kernel.h"
#include "stages/parameterize/map/walk.h"

namespace lozenge {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A step is first taken so many times as long as Newton's: what is far from settled moves on faster, as in successive
/// over-relaxation, and where that is too far, the energy tells and the step itself is taken.
constexpr double kOverrelaxation = 1.5;
/// Newton's step and its halves, down to a thirty-second: a step that helps no more than that is not worth the search.
constexpr int kMostAttempts = 7;

/// The wedges around a free vertex, in the frame of its home.
void make_wedges(const WorkingMap& map, VertexId v, double scale, Wedges& wedges) {
  wedges.start(scale);
  const Halfedge first = map.mesh.outgoing[v];
  const auto neighbour = [&](Halfedge h, Halfedge end) {
    const Vec2d& at = map.at[map.mesh.start(end)];
    const UnitMotion& mine = map.chart[h];
    const UnitMotion& its = map.chart[end];
    return mine == its ? at : composed(inverse(mine), its)(at);
  };
  Halfedge h = first;
  const Vec2d x = map.at[v];
  const Vec2d start = neighbour(h, next_in_triangle(h)) - x;
  Vec2d p = start;
  for (;;) {
    const Halfedge next = map.mesh.next_around(h);
    const Vec2d q = next == first ? start
                    : next < 0    ? neighbour(h, previous_in_triangle(h)) - x
                                  : neighbour(next, next_in_triangle(next)) - x;
    wedges.add(map.rest[h / 3], h % 3, p, q);
    if (next == first || next < 0) break;
    p = q;
    h = next;
  }
  wedges.close();
}

/// Newton's step of a free vertex; of one on the boundary along its side.
NewtonStep step_of_vertex(const WorkingMap& map, VertexId v, const Wedges& wedges) {
  if (!map.mesh.on_boundary(v)) return newton_step(map.energy, wedges);
  return newton_step_along(map.energy, wedges, direction_of(boundary_place(map, v).side.side));
}

/// Puts a free vertex at a point of its home's frame that its ring is seen from, moving it to another home where the
/// point lies outside.
/// \return false, with nothing changed, where the way there leaves the domain
bool move_vertex(WorkingMap& map, VertexId v, const Vec2d& to) {
  if (map.mesh.on_boundary(v)) return slide_to(map, v, to);
  const auto b = barycentrics(to);
  if (b[0] >= 0 && b[1] >= 0 && b[2] >= 0) {
    map.at[v] = to;
    return true;
  }
  const auto walked = walk(map.domain, map.home[v], map.at[v], to);
  if (walked) move_home(map, v, walked->home, walked->at, walked->back);
  return walked.has_value();
}

/// Where a vertex of the boundary lies furthest inside of what sees its ring: the middle of the part of its line from
/// which no triangle around is folded; nothing where there is no such part.
std::optional<Vec2d> middle_of_kernel_on_line(const std::vector<Vec2d>& ring, const Vec2d& at, const Vec2d& direction) {
  double low = -kInfinity;
  double high = kInfinity;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    // The doubled area with the vertex moved by x along the line: base + slope x.
    const double base = cross(ring[i] - at, ring[i + 1] - at);
    const double slope = cross(ring[i + 1] - ring[i], direction);
    if (slope > 0) low = std::max(low, -base / slope);
    else if (slope < 0) high = std::min(high, -base / slope);
    else if (!(base > 0)) return std::nullopt;
  }
  // The neighbours on the boundary lie on the line, before and behind.
  high = std::min(high, direction.dot(ring.front() - at));
  low = std::max(low, direction.dot(ring.back() - at));
  if (!(low < high)) return std::nullopt;
  return at + direction * ((low + high) / 2);
}

/// A place for a vertex whose ring this is that folds none of the triangles around it.
std::optional<Vec2d> middle_of_kernel(const WorkingMap& map, VertexId v, const Ring& ring) {
  if (!map.mesh.on_boundary(v)) return point_of_kernel(ring.at);
  return middle_of_kernel_on_line(ring.at, map.at[v], direction_of(boundary_place(map, v).side.side));
}

/// Or has so little area that in another triangle's frame it may be folded: coordinates are rounded there.
bool is_folded(const FlatImage& p) {
  constexpr double kRounding = 1e-15;
  const double area = doubled_area(p);
  const double longest = std::max({(p[1] - p[0]).length2(), (p[2] - p[1]).length2(), (p[0] - p[2]).length2()});
  return !(area > 0 && area * area > kRounding * kRounding * longest);
}

bool has_fold(const WorkingMap& map, VertexId v) {
  bool folded = false;
  for_each_outgoing(map.mesh, v, [&](Halfedge h) { folded = folded || is_folded(flat_image(map, h / 3)); });
  return folded;
}

/// A step of a free vertex; `move(to)` says whether it could go there.
template <typename Move>
double step_of(const WorkingMap& map, VertexId v, double scale, Wedges& wedges, double& excess, Move&& move) {
  make_wedges(map, v, scale, wedges);
  const Vec2d x = map.at[v];
  const NewtonStep newton = step_of_vertex(map, v, wedges);
  if (!(newton.energy < kInfinity)) return 0;
  excess += newton.energy - wedges.share();
  Vec2d step = newton.step * kOverrelaxation;
  for (int attempt = 0; attempt < kMostAttempts; ++attempt, step = attempt == 1 ? newton.step : step * 0.5) {
    const double after = energy_at(map.energy, wedges, step);
    if (after < newton.energy && move(x + step)) return newton.energy - after;
  }
  return 0;
}

double relax_vertex(WorkingMap& map, VertexId v, double scale, Wedges& wedges, double& excess) {
  if (map.pin[v] >= 0) return 0;
  return step_of(map, v, scale, wedges, excess, [&](const Vec2d& to) { return move_vertex(map, v, to); });
}

}  // namespace

double relax_vertex(WorkingMap& map, VertexId v, Wedges& wedges) {
  double excess = 0;
  return relax_vertex(map, v, map.scale(), wedges, excess);
}

double relax_at_home(WorkingMap& map, VertexId v, double scale, Wedges& wedges, double& excess) {
  return step_of(map, v, scale, wedges, excess, [&](const Vec2d& to) {
    map.at[v] = to;
    return true;
  });
}

double relax(WorkingMap& map, const std::vector<VertexId>& vertices, const RelaxOptions& options) {
  const double scale = map.scale();
  Wedges wedges;
  double fallen = 0;
  for (int sweep = 0; sweep < options.most_sweeps; ++sweep) {
    double gain = 0;
    double excess = 0;  // of the energies around the visited vertices over those of an isometry
    if (sweep % 2 == 0) {
      for (const VertexId v : vertices) gain += relax_vertex(map, v, scale, wedges, excess);
    } else {
      for (auto v = vertices.rbegin(); v != vertices.rend(); ++v) gain += relax_vertex(map, *v, scale, wedges, excess);
    }
    fallen += gain;
    // A triangle is visited from each of its corners.
    if (gain <= options.tolerance * excess / 3) break;
  }
  return fallen;
}

bool heal_folds(WorkingMap& map, const std::vector<VertexId>& vertices) {
  constexpr int kRounds = 8;  // a bound on the time: what isn't healed then is refused
  Ring ring;
  bool folded = true;
  for (int round = 0; round < kRounds && folded; ++round) {
    folded = false;
    for (const VertexId v : vertices) {
      if (!has_fold(map, v)) continue;
      folded = true;
      if (map.pin[v] >= 0) continue;
      gather_ring(map, v, ring);
      Vec2d mean(0, 0);
      for (const Vec2d& p : ring.at) mean += p / static_cast<double>(ring.at.size());
      move_vertex(map, v, middle_of_kernel(map, v, ring).value_or(mean));
    }
  }
  if (!folded) return true;
  return std::none_of(vertices.begin(), vertices.end(), [&](VertexId v) { return has_fold(map, v); });
}

void move_into_kernels(WorkingMap& map, const std::vector<VertexId>& vertices) {
  Ring ring;
  for (const VertexId v : vertices) {
    if (map.pin[v] >= 0) continue;
    gather_ring(map, v, ring);
    if (const auto middle = middle_of_kernel(map, v, ring)) move_vertex(map, v, *middle);
  }
}

}  // namespace lozenge
