// A queue of edges by length; an edge that would leave thin triangles waits as if it were longer. Of its two ends the
// one goes whose triangles stay rounder; none goes where the topology would change or a triangle turn over in space.
#include "stages/parameterize/levels/simplify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace lozenge {

namespace {

/// Triangles may turn by at most about 75 degrees when a vertex is removed.
constexpr float kMostTurn = 0.25F;
/// Shapes below this are all as bad.
constexpr float kThinnest = 0.05F;
/// More triangles than this around one vertex make long thin fans.
constexpr int kMostDegree = 12;
/// A boundary may turn by at most about 37 degrees where a vertex of it is removed: it keeps its corners.
constexpr float kMostBoundaryTurn = 0.8F;

class Simplifier {
 public:
  Simplifier(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, const RemovalGuard& guard)
      : mesh_(mesh), positions_(positions), guard_(guard) {}

  /// All edges, until so many triangles are left.
  std::vector<Removal> run(std::int32_t target) {
    std::int32_t left = 0;
    for (TriangleId t = 0; t < mesh_.triangle_count(); ++t) left += !mesh_.removed(t);
    std::vector<Entry> entries;
    entries.reserve(mesh_.twins.size() / 2);
    for (Halfedge h = 0; h < static_cast<Halfedge>(mesh_.twins.size()); ++h) {
      if (!mesh_.removed(h / 3) && is_named(h)) entries.push_back(entry(h));
    }
    return run(std::move(entries), left - target, std::numeric_limits<float>::infinity());
  }

  /// The edges that leave these vertices, while they are shorter than `longest`.
  std::vector<Removal> run(const std::vector<VertexId>& vertices, float longest) {
    std::vector<Entry> entries;
    for (const VertexId v : vertices) {
      for_each_outgoing(mesh_, v, [&](Halfedge h) {
        if (is_named(h) || !guard_.may_grow(mesh_.end(h))) entries.push_back(entry(h));
      });
    }
    return run(std::move(entries), std::numeric_limits<std::int32_t>::max(), longest * longest);
  }

 private:
  struct Entry {
    float cost;    ///< the length; once the triangles have been looked at that are left, by their shape, too
    float length;  ///< squared
    Halfedge halfedge;
    bool operator<(const Entry& other) const {
      return cost != other.cost ? cost > other.cost : halfedge > other.halfedge;
    }
  };
  using Queue = std::priority_queue<Entry>;

  /// \param most  triangles that may go
  std::vector<Removal> run(std::vector<Entry> entries, std::int32_t most, float longest_squared) {
    queue_ = Queue({}, std::move(entries));
    std::vector<Removal> removals;
    while (most > 0 && !queue_.empty()) {
      const Entry e = queue_.top();
      if (e.cost > longest_squared) break;
      queue_.pop();
      if (mesh_.removed(e.halfedge / 3) || entry(e.halfedge).length != e.length) continue;
      const auto [removal, shape] = better_direction(e.halfedge);
      if (removal.vertex < 0) continue;
      // Seen first for its length alone: it waits for its turn if it leaves thin triangles.
      const float cost = e.length / std::max(shape, kThinnest);
      if (cost > e.cost) {
        queue_.push({cost, e.length, e.halfedge});
        continue;
      }
      const VertexId kept = end_of(mesh_, removal);
      remove_vertex(mesh_, removal);
      if (guard_.removed && !guard_.removed(removal)) {
        undo_removal(mesh_, removal);
        continue;
      }
      most -= removal.triangles();
      removals.push_back(removal);
      for_each_outgoing(mesh_, kept, [&](Halfedge out) { queue_.push(entry(out)); });
      if (mesh_.on_boundary(kept)) queue_.push(entry(previous_in_triangle(last_of_fan(mesh_, mesh_.outgoing[kept]))));
    }
    return removals;
  }

  /// An edge goes by its lower half-edge.
  bool is_named(Halfedge h) const { return mesh_.twins[h] < 0 || mesh_.twins[h] > h; }

  Entry entry(Halfedge h) const {
    const float length = (positions_[mesh_.end(h)] - positions_[mesh_.start(h)]).length2();
    return {length, length, mesh_.twins[h] < 0 ? h : std::min(h, mesh_.twins[h])};
  }

  /// Of the edge's two ends, the one whose removal leaves the rounder triangles, and the worst shape of those; vertex
  /// -1 where neither can be removed.
  std::pair<Removal, float> better_direction(Halfedge h) {
    const Halfedge g = mesh_.twins[h];
    const Removal start{h, g, mesh_.start(h)};
    const Removal end{g, h, mesh_.end(h)};
    const bool start_may_go = is_allowed(start);
    const bool end_may_go = is_allowed(end);
    if ((!start_may_go && !end_may_go) || !fulfils_link_condition(start)) return {{}, 0};
    const float forth = start_may_go && keeps_topology(start) ? worst_shape(start, 0) : 0;
    const float back = end_may_go && keeps_topology(end) ? worst_shape(end, forth) : 0;
    if (forth <= 0 && back <= 0) return {{}, 0};
    return forth >= back ? std::pair(start, forth) : std::pair(end, back);
  }

  bool is_allowed(const Removal& r) const {
    return (!guard_.may_remove || guard_.may_remove(r.vertex)) &&
           (!guard_.may_grow || guard_.may_grow(end_of(mesh_, r)));
  }

  /// The smallest quality (1: equilateral, 0: flat) of the triangles that a removal leaves; 0 or less where one of them
  /// would turn over. \param enough  nothing at or below this matters: any number that isn't above it may come back
  float worst_shape(const Removal& r, float enough) const {
    const VertexId v = r.vertex;
    const Vec3f& to = positions_[end_of(mesh_, r)];
    float worst = 1;
    // From the triangle after the left one to the one before the right one.
    const Halfedge end = r.right >= 0 ? next_in_triangle(r.right) : -1;
    Halfedge out = r.left >= 0 ? mesh_.next_around(r.left) : mesh_.outgoing[v];
    for (; out != end && worst > enough; out = mesh_.next_around(out)) {
      const Vec3f& p = positions_[mesh_.end(out)];
      const Vec3f& q = positions_[mesh_.opposite(out)];
      const Vec3f before = (p - positions_[v]).cross(q - positions_[v]);
      const Vec3f after = (p - to).cross(q - to);
      const float scale = before.length() * after.length();
      if (!(before.dot(after) > kMostTurn * scale) || scale == 0) {
        // A triangle without area has no direction to keep.
        if (!(before.length() == 0 && after.length() > 0)) return 0;
      }
      const float sides = (p - to).length2() + (q - p).length2() + (to - q).length2();
      worst = std::min(worst, 3.4641016F * after.length() / sides);
    }
    return worst;
  }

  /// No vertex is a neighbour of both ends but those opposite the edge, which keep the triangles that they need: the
  /// same for either end.
  bool fulfils_link_condition(const Removal& r) {
    const VertexId v = r.vertex;
    const VertexId u = end_of(mesh_, r);
    const auto [left, right] = opposite_corners(mesh_, r);
    if (left == right) return false;
    gather_neighbours(v, around_one_);
    gather_neighbours(u, around_other_);
    int common = 0;
    for (const VertexId w : around_other_)
      common += static_cast<int>(std::count(around_one_.begin(), around_one_.end(), w));
    if (common != r.triangles()) return false;
    for (const VertexId w : {left, right}) {
      if (w >= 0 && degree(w) <= (mesh_.on_boundary(w) ? 1 : 3)) return false;
    }
    return true;
  }

  /// No vertex of fewer triangles than it needs, no fan too large, and the boundary where it was.
  /// \pre the link condition was found to hold
  bool keeps_topology(const Removal& r) const {
    const VertexId v = r.vertex;
    const VertexId u = end_of(mesh_, r);
    const bool inner_edge = r.left >= 0 && r.right >= 0;
    if (inner_edge && mesh_.on_boundary(v)) return false;
    if (!inner_edge && !is_gentle(v, u)) return false;
    const int degree_u = degree(u);
    const int degree_after = degree(v) + degree_u - 2 * r.triangles();
    if (mesh_.on_boundary(u)) {
      const auto [left, right] = opposite_corners(mesh_, r);
      return degree_after >= 1 && degree_after <= std::max(kMostDegree / 2 + 1, degree_u) &&
             (!inner_edge || !makes_chord(v, u, left, right));
    }
    return degree_after <= std::max(kMostDegree, degree_u) && degree_after >= 3;
  }

  void gather_neighbours(VertexId v, std::vector<VertexId>& neighbours) const {
    neighbours.clear();
    for_each_neighbour(mesh_, v, [&](VertexId w) { neighbours.push_back(w); });
  }

  /// Triangles around a vertex.
  int degree(VertexId v) const {
    int count = 0;
    for_each_outgoing(mesh_, v, [&](Halfedge) { ++count; });
    return count;
  }

  /// Whether the boundary, which goes on from v to another vertex than u, hardly turns in v, and v is no ear's tip.
  bool is_gentle(VertexId v, VertexId u) const {
    const Halfedge first = mesh_.outgoing[v];
    const Halfedge last = last_of_fan(mesh_, first);
    if (first == last) return false;
    const VertexId w = mesh_.end(first) == u ? mesh_.opposite(last) : mesh_.end(first);
    const Vec3f straight = positions_[u] - positions_[w];
    const auto agrees = [&](const Vec3f& part) {
      return straight.dot(part) >= kMostBoundaryTurn * straight.length() * part.length();
    };
    return agrees(positions_[u] - positions_[v]) && agrees(positions_[v] - positions_[w]);
  }

  /// Whether u, on the boundary, would be joined to another vertex of the boundary through the inside.
  bool makes_chord(VertexId v, VertexId u, VertexId left, VertexId right) const {
    bool found = false;
    for_each_neighbour(
        mesh_, v, [&](VertexId w) { found = found || (w != u && w != left && w != right && mesh_.on_boundary(w)); });
    return found;
  }

  HalfedgeMesh& mesh_;
  const std::vector<Vec3f>& positions_;
  const RemovalGuard& guard_;
  Queue queue_;
  std::vector<VertexId> around_one_, around_other_;  ///< the ends of the edge that is looked at
};

}  // namespace

std::vector<Removal> simplify(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, std::int32_t triangles,
                              const RemovalGuard& guard) {
  return Simplifier(mesh, positions, guard).run(triangles);
}

std::vector<Removal> simplify_edges(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions,
                                    const std::vector<VertexId>& vertices, float longest, const RemovalGuard& guard) {
  return Simplifier(mesh, positions, guard).run(vertices, longest);
}

}  // namespace lozenge
