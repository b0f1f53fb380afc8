#include "stages/import/sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

namespace lozenge {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// A triangle beside an edge.
struct Wing {
  HalfEdge half_edge = 0;
  bool up = false;    ///< runs from the lower vertex to the higher
  bool flat = false;  ///< has no angle
  double angle = 0;   ///< around the edge, counter-clockwise seen from the higher vertex, from 0 to 2 pi
};

/// The wings of one edge, which have a plane each that holds it.
std::vector<Wing> wings_of(const SourceMesh& mesh, std::span<const HalfEdge> edge) {
  const VertexId low = std::min(half_edge_start(mesh, edge[0]), half_edge_end(mesh, edge[0]));
  const VertexId high = std::max(half_edge_start(mesh, edge[0]), half_edge_end(mesh, edge[0]));
  const Vec3d origin(mesh.positions[low]);
  const Vec3d axis = (Vec3d(mesh.positions[high]) - origin).normalized();
  // The coordinate axis that is farthest from the edge's direction.
  int least = 0;
  for (int i = 1; i < 3; ++i) least = std::abs(axis[i]) < std::abs(axis[least]) ? i : least;
  Vec3d other(0, 0, 0);
  other[least] = 1;
  const Vec3d u = axis.cross(other).normalized();
  const Vec3d v = axis.cross(u);
  std::vector<Wing> wings;
  for (const HalfEdge h : edge) {
    const Vec3d apex = Vec3d(mesh.positions[mesh.triangles[h / 3][(h % 3 + 2) % 3]]) - origin;
    const double x = apex.dot(u);
    const double y = apex.dot(v);
    // Below this share of the apex's distance the angle is rounding.
    constexpr double kFlat = 1e-12;
    const bool flat = !(std::hypot(x, y) > kFlat * apex.length());
    double angle = flat ? 0 : std::atan2(y, x);
    if (angle < 0) angle += kTurn;
    wings.push_back({h, half_edge_start(mesh, h) == low, flat, angle});
  }
  return wings;
}

class Matching {
 public:
  Matching(const std::vector<Wing>& wings, std::vector<HalfEdge>& twins)
      : wings_(wings), twins_(twins), taken_(wings.size(), false) {}

  void run() {
    // Above this, all pairs would be too many to try.
    constexpr std::size_t kMostForAllPairs = 24;
    if (wings_.size() <= kMostForAllPairs) {
      match_straightest_first();
    } else {
      match_neighbours();
    }
    match_flat_ones();
  }

 private:
  /// Seen along the edge, the solid between a wing that runs down and one that runs up lies counter-clockwise from the
  /// former: its angle.
  double solid_angle(std::size_t down, std::size_t up) const {
    const double angle = wings_[up].angle - wings_[down].angle;
    return angle < 0 ? angle + kTurn : angle;
  }

  void match_straightest_first() {
    // In steps of a millionth of a radian, so that rounding doesn't decide between what is meant to be equal.
    const auto steps = [](double angle) { return std::llround(angle * 1e6); };
    std::vector<std::tuple<long long, long long, std::size_t, std::size_t>> pairs;
    for (std::size_t down = 0; down < wings_.size(); ++down) {
      for (std::size_t up = 0; up < wings_.size(); ++up) {
        if (wings_[down].up || !wings_[up].up || wings_[down].flat || wings_[up].flat) continue;
        const double angle = solid_angle(down, up);
        pairs.emplace_back(steps(std::abs(angle - std::numbers::pi)), steps(angle), down, up);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [bend, angle, down, up] : pairs) {
      if (!taken_[down] && !taken_[up]) match(down, up);
    }
  }

  /// Once around the edge, as brackets are matched: a wing that runs down opens a solid, the next that runs up closes
  /// it.
  void match_neighbours() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < wings_.size(); ++i) {
      if (!wings_[i].flat) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wings_[a].angle < wings_[b].angle; });
    std::vector<std::size_t> open;
    // Twice, since what opens at the end of the first round closes in the second.
    for (int round = 0; round < 2; ++round) {
      for (const std::size_t i : order) {
        if (taken_[i]) continue;
        if (!wings_[i].up) {
          if (round == 0) open.push_back(i);
        } else if (!open.empty()) {
          match(open.back(), i);
          open.pop_back();
        }
      }
    }
  }

  /// What has no angle goes with what is left, in their order.
  void match_flat_ones() {
    std::size_t down = 0;
    std::size_t up = 0;
    const auto advance = [&](std::size_t& i, bool runs_up) {
      while (i < wings_.size() && (taken_[i] || wings_[i].up != runs_up)) ++i;
      return i < wings_.size();
    };
    if (std::none_of(wings_.begin(), wings_.end(), [](const Wing& wing) { return wing.flat; })) return;
    while (advance(down, false) && advance(up, true)) match(down, up);
  }

  void match(std::size_t a, std::size_t b) {
    taken_[a] = taken_[b] = true;
    twins_[wings_[a].half_edge] = wings_[b].half_edge;
    twins_[wings_[b].half_edge] = wings_[a].half_edge;
  }

  const std::vector<Wing>& wings_;
  std::vector<HalfEdge>& twins_;
  std::vector<bool> taken_;
};

/// Half-edges of crowded edges, those of one edge side by side.
std::vector<HalfEdge> crowded_half_edges(const SourceMesh& mesh, const std::vector<HalfEdge>& twins) {
  std::vector<HalfEdge> crowded;
  for (std::size_t h = 0; h < twins.size(); ++h) {
    if (twins[h] == kCrowdedTwin) crowded.push_back(static_cast<HalfEdge>(h));
  }
  const auto key = [&](HalfEdge h) {
    const VertexId a = half_edge_start(mesh, h);
    const VertexId b = half_edge_end(mesh, h);
    return std::tuple(std::min(a, b), std::max(a, b), h);
  };
  std::sort(crowded.begin(), crowded.end(), [&](HalfEdge g, HalfEdge h) { return key(g) < key(h); });
  return crowded;
}

bool same_edge(const SourceMesh& mesh, HalfEdge g, HalfEdge h) {
  const VertexId a = half_edge_start(mesh, g);
  const VertexId b = half_edge_end(mesh, g);
  return (a == half_edge_start(mesh, h) && b == half_edge_end(mesh, h)) ||
         (b == half_edge_start(mesh, h) && a == half_edge_end(mesh, h));
}

}  // namespace

std::vector<HalfEdge> pair_sheets(const SourceMesh& mesh, const HalfEdgeLinks& links, RepairReport& report) {
  std::vector<HalfEdge> twins = links.twins;
  const std::vector<HalfEdge> crowded = crowded_half_edges(mesh, twins);
  for (std::size_t h = 0; h < twins.size(); ++h) {
    const HalfEdge twin = twins[h];
    if (is_same_direction_twin(twin) && same_direction_twin(twin) > static_cast<HalfEdge>(h)) {
      report.add(RepairKind::kCutEdges, mesh.positions[half_edge_start(mesh, static_cast<HalfEdge>(h))]);
    }
    if (twin < 0) twins[h] = kNoTwin;
  }
  for (std::size_t begin = 0; begin < crowded.size();) {
    std::size_t end = begin + 1;
    while (end < crowded.size() && same_edge(mesh, crowded[begin], crowded[end])) ++end;
    const std::vector<Wing> wings = wings_of(mesh, std::span(crowded).subspan(begin, end - begin));
    Matching(wings, twins).run();
    report.add(RepairKind::kCrowdedEdges, mesh.positions[half_edge_start(mesh, crowded[begin])]);
    begin = end;
  }
  return twins;
}

}  // namespace lozenge
