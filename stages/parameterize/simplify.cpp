#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "stages/parameterize/levels.h"

namespace lozenge {

namespace {

/// Triangles may turn by at most about 75 degrees when a vertex is removed.
constexpr float kMostTurn = 0.25F;
/// Shapes below this are all as bad.
constexpr float kThinnest = 0.05F;
/// More triangles than this around one vertex make long thin fans.
constexpr int kMostDegree = 12;

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
      if (!mesh_.removed(h / 3) && mesh_.twins[h] > h) entries.push_back(entry(h));
    }
    return run(std::move(entries), std::max(0, (left - target + 1) / 2), std::numeric_limits<float>::infinity());
  }

  /// The edges that leave these vertices, while they are shorter than `longest`.
  std::vector<Removal> run(const std::vector<VertexId>& vertices, float longest) {
    std::vector<Entry> entries;
    for (const VertexId v : vertices) {
      for_each_outgoing(mesh_, v, [&](Halfedge h) {
        if (mesh_.twins[h] > h || !guard_.may_grow(mesh_.end(h))) entries.push_back(entry(h));
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

  std::vector<Removal> run(std::vector<Entry> entries, std::int32_t most_removals, float longest_squared) {
    queue_ = Queue({}, std::move(entries));
    std::vector<Removal> removals;
    while (static_cast<std::int32_t>(removals.size()) < most_removals && !queue_.empty()) {
      const Entry e = queue_.top();
      if (e.cost > longest_squared) break;
      queue_.pop();
      if (mesh_.removed(e.halfedge / 3) || entry(e.halfedge).length != e.length) continue;
      const auto [h, shape] = better_direction(e.halfedge);
      if (h < 0) continue;
      // Seen first for its length alone: it waits for its turn if it leaves thin triangles.
      const float cost = e.length / std::max(shape, kThinnest);
      if (cost > e.cost) {
        queue_.push({cost, e.length, e.halfedge});
        continue;
      }
      const Removal removal{h, mesh_.start(h)};
      const VertexId kept = mesh_.end(h);
      remove(h);
      if (guard_.removed && !guard_.removed(removal)) {
        undo_removal(mesh_, removal);
        continue;
      }
      removals.push_back(removal);
      for_each_outgoing(mesh_, kept, [&](Halfedge out) { queue_.push(entry(out)); });
    }
    return removals;
  }

  Entry entry(Halfedge h) const {
    const float length = (positions_[mesh_.end(h)] - positions_[mesh_.start(h)]).length2();
    return {length, length, std::min(h, mesh_.twins[h])};
  }

  /// Of the half-edge and its twin, the one whose collapse leaves the rounder triangles, and the worst shape of those;
  /// -1 where neither can be collapsed.
  std::pair<Halfedge, float> better_direction(Halfedge h) const {
    const Halfedge g = mesh_.twins[h];
    const float forth = worst_shape(h);
    const float back = worst_shape(g);
    if (forth <= 0 && back <= 0) return {-1, 0};
    return forth >= back ? std::pair(h, forth) : std::pair(g, back);
  }

  /// The smallest quality (1: equilateral, 0: flat) of the triangles that collapsing h leaves; 0 or less where it must
  /// not be.
  float worst_shape(Halfedge h) const {
    const VertexId v = mesh_.start(h);
    const VertexId u = mesh_.end(h);
    if (guard_.may_remove && !guard_.may_remove(v)) return 0;
    if (guard_.may_grow && !guard_.may_grow(u)) return 0;
    if (!keeps_topology(h)) return 0;
    const Vec3f& to = positions_[u];
    float worst = 1;
    // From the triangle after h's own to the one before its twin's.
    for (Halfedge out = mesh_.next_around(h); out != next_in_triangle(mesh_.twins[h]); out = mesh_.next_around(out)) {
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

  /// Link condition, no vertex of fewer than 3 triangles, and no fan too large.
  bool keeps_topology(Halfedge h) const {
    const VertexId v = mesh_.start(h);
    const VertexId u = mesh_.end(h);
    const VertexId l = mesh_.opposite(h);
    const VertexId r = mesh_.opposite(mesh_.twins[h]);
    if (l == r) return false;
    int degree_v = 0, degree_u = 0, degree_l = 0, degree_r = 0, common = 0;
    for_each_outgoing(mesh_, v, [&](Halfedge) { ++degree_v; });
    for_each_outgoing(mesh_, l, [&](Halfedge) { ++degree_l; });
    for_each_outgoing(mesh_, r, [&](Halfedge) { ++degree_r; });
    for_each_outgoing(mesh_, u, [&](Halfedge out) {
      ++degree_u;
      const VertexId w = mesh_.end(out);
      for_each_outgoing(mesh_, v, [&](Halfedge other) { common += mesh_.end(other) == w; });
    });
    return common == 2 && degree_l > 3 && degree_r > 3 && degree_v + degree_u - 4 <= std::max(kMostDegree, degree_u) &&
           degree_v + degree_u - 4 >= 3;
  }

  void remove(Halfedge h) {
    const Halfedge g = mesh_.twins[h];
    const VertexId v = mesh_.start(h);
    const VertexId u = mesh_.end(h);
    const VertexId l = mesh_.opposite(h);
    const VertexId r = mesh_.opposite(g);
    const Halfedge lu = mesh_.twins[next_in_triangle(h)];
    const Halfedge vl = mesh_.twins[previous_in_triangle(h)];
    const Halfedge ur = mesh_.twins[previous_in_triangle(g)];
    const Halfedge rv = mesh_.twins[next_in_triangle(g)];
    for (Halfedge out = vl;; out = mesh_.next_around(out)) {
      mesh_.triangles[out / 3][out % 3] = u;
      if (previous_in_triangle(out) == rv) break;
    }
    mesh_.twins[lu] = vl;
    mesh_.twins[vl] = lu;
    mesh_.twins[ur] = rv;
    mesh_.twins[rv] = ur;
    mesh_.triangles[h / 3] = {-1, -1, -1};
    mesh_.triangles[g / 3] = {-1, -1, -1};
    mesh_.outgoing[v] = -1;
    mesh_.outgoing[u] = vl;
    mesh_.outgoing[l] = lu;
    mesh_.outgoing[r] = rv;
  }

  HalfedgeMesh& mesh_;
  const std::vector<Vec3f>& positions_;
  const RemovalGuard& guard_;
  Queue queue_;
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

void undo_removal(HalfedgeMesh& mesh, const Removal& removal) {
  // The dead triangles still know their neighbours, and those are as they were when the vertex went.
  const Halfedge h = removal.halfedge;
  const Halfedge g = mesh.twins[h];
  const VertexId v = removal.vertex;
  const Halfedge lu = mesh.twins[next_in_triangle(h)];
  const Halfedge vl = mesh.twins[previous_in_triangle(h)];
  const Halfedge ur = mesh.twins[previous_in_triangle(g)];
  const Halfedge rv = mesh.twins[next_in_triangle(g)];
  const VertexId l = mesh.start(lu);
  const VertexId u = mesh.end(lu);
  const VertexId r = mesh.start(rv);
  for (Halfedge out = vl;; out = mesh.next_around(out)) {
    mesh.triangles[out / 3][out % 3] = v;
    if (previous_in_triangle(out) == rv) break;
  }
  mesh.twins[lu] = next_in_triangle(h);
  mesh.twins[vl] = previous_in_triangle(h);
  mesh.twins[ur] = previous_in_triangle(g);
  mesh.twins[rv] = next_in_triangle(g);
  auto& left = mesh.triangles[h / 3];
  left[h % 3] = v;
  left[(h % 3 + 1) % 3] = u;
  left[(h % 3 + 2) % 3] = l;
  auto& right = mesh.triangles[g / 3];
  right[g % 3] = u;
  right[(g % 3 + 1) % 3] = v;
  right[(g % 3 + 2) % 3] = r;
  mesh.outgoing[v] = h;
  mesh.outgoing[u] = g;
}

}  // namespace lozenge
