// A vertex goes back into the hole that its triangles left: to the place that its distances in space ask for, where
// that sees the whole hole, else ever nearer to the vertex that it was collapsed into. Where that one is a cone that
// nothing else sees all around, it takes the cone's place. After each level, twice as fine as the one before, the map
// relaxes.
#include "stages/parameterize/levels/refine.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/compact_map.h"
#include "stages/parameterize/map/fan.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/local_optimization.h"
#include "stages/parameterize/relax/sweeps.h"

namespace lozenge {

namespace {

/// The ring's mean with the weights that the vertex has in space (mean value coordinates, which are positive).
Vec2d mean_value_point(const WorkingMap& map, VertexId v, const std::vector<VertexId>& ring,
                       const std::vector<Vec2d>& outline) {
  const Vec3d centre((*map.positions)[v]);
  const std::size_t n = ring.size();
  std::vector<double> half_tangent(n);
  const auto direction = [&](std::size_t i) { return Vec3d((*map.positions)[ring[i % n]]) - centre; };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d p = direction(i), q = direction(i + 1);
    // tan(angle / 2) = sin / (1 + cos)
    const double lengths = p.length() * q.length();
    const double down = lengths + p.dot(q);
    half_tangent[i] = down > 1e-12 * lengths ? p.cross(q).length() / down : 0;
  }
  Vec2d sum(0, 0);
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double length = direction(i).length();
    if (!(length > 0)) continue;
    const double weight = (half_tangent[i] + half_tangent[(i + n - 1) % n]) / length;
    sum += outline[i] * weight;
    total += weight;
  }
  return total > 0 ? sum / total : outline[0];
}

class Refinement {
 public:
  explicit Refinement(WorkingMap& map) : map_(map) {}

  /// \return false, with the vertex still removed, where it finds no place
  bool put_back(const Removal& removal) {
    const Hole triangles = hole_of(map_.mesh, removal);
    const Fan hole = lay_out_fan(map_, triangles.first, triangles.last);
    if (const auto place = place_for(removal, hole)) {
      put_into(removal, hole, *place);
    } else if (!take_over(removal, hole)) {
      return false;
    }
    for_each_outgoing(map_.mesh, removal.vertex, [&](Halfedge h) {
      map_.rest[h / 3] = rest_shape(*map_.positions, map_.mesh.triangles[h / 3], map_.surface_area, map_.flattest);
    });
    relax_vertex(map_, removal.vertex, wedges_);
    return true;
  }

 private:
  static bool is_on_boundary(const Removal& removal) { return removal.left < 0 || removal.right < 0; }

  std::optional<PlaceInFan> place_for(const Removal& removal, const Fan& hole) const {
    const HalfedgeMesh& mesh = map_.mesh;
    const Halfedge first = hole.slices.front().spoke;
    const Halfedge last = hole.slices.back().spoke;
    const VertexId kept = mesh.start(first);
    if (is_on_boundary(removal)) {
      const VertexId next = removal.left >= 0 ? mesh.opposite(last) : mesh.end(first);
      const auto distance = [&](VertexId v) {
        return Vec3d((*map_.positions)[v] - (*map_.positions)[removal.vertex]).length();
      };
      const double both = distance(kept) + distance(next);
      return find_place_on_boundary(map_, hole, removal.left >= 0 ? Along::kBack : Along::kAhead,
                                    both > 0 ? distance(kept) / both : 0.5);
    }
    std::vector<VertexId> ring{kept};
    for (const Fan::Slice& slice : hole.slices) ring.push_back(mesh.end(slice.spoke));
    ring.push_back(mesh.opposite(last));
    return find_place(map_, hole, mean_value_point(map_, removal.vertex, ring, hole.outline));
  }

  /// Puts v into its hole. Its own triangles take the frames of the hole's triangles beside them.
  void put_into(const Removal& removal, const Fan& hole, const PlaceInFan& place) {
    const Halfedge first = hole.slices.front().spoke;
    const Halfedge last = hole.slices.back().spoke;
    const auto chart = [&](const Fan::Slice& slice) { return composed(inverse(slice.into_fan), place.into_fan); };
    if (removal.left >= 0) {
      set_charts(removal.left, {chart(hole.slices.front()), map_.chart[first], map_.chart[next_in_triangle(first)]});
    }
    if (removal.right >= 0) {
      set_charts(removal.right, {map_.chart[last], chart(hole.slices.back()), map_.chart[previous_in_triangle(last)]});
    }
    for (const Fan::Slice& slice : hole.slices) map_.chart[slice.spoke] = chart(slice);
    undo_removal(map_.mesh, removal);
    set_home(map_, removal.vertex, place.home, place.at);
  }

  /// What is around the vertex in the middle of the hole beside the hole.
  std::optional<Fan> rest_of(const Removal& removal, const Fan& hole) const {
    const HalfedgeMesh& mesh = map_.mesh;
    const Halfedge first = hole.slices.front().spoke;
    const Halfedge last = hole.slices.back().spoke;
    const Halfedge after = removal.right >= 0 ? mesh.next_around(last) : mesh.outgoing[mesh.start(first)];
    const Halfedge before = removal.left >= 0 ? mesh.previous_around(first) : last_of_fan(mesh, last);
    if (after < 0 || before < 0) return std::nullopt;
    return lay_out_fan(map_, after, before);
  }

  /// Around a cone of more than a full turn a hole may be too wide for any point to see all of it but the cone itself;
  /// on the boundary, of more than half of one. Then the vertex takes the place of u, the one pinned there, and u moves
  /// into the rest of what was around it.
  bool take_over(const Removal& removal, const Fan& hole) {
    const VertexId u = map_.mesh.start(hole.slices.front().spoke);
    const DomainVertex cone = map_.pin[u];
    if (cone < 0 || map_.kept[cone] || map_.mesh.on_boundary(u) != is_on_boundary(removal)) return false;
    const auto rest = rest_of(removal, hole);
    if (!rest) return false;
    constexpr double kHalfway = 0.5;
    const Along way = removal.left >= 0 ? Along::kAhead : Along::kBack;
    const auto place = is_on_boundary(removal) ? find_place_on_boundary(map_, *rest, way, kHalfway)
                                               : find_place(map_, *rest, mean_of(rest->outline));
    if (!place) return false;
    const UnitPoint before = corner_step(corner_of_pinned(map_, u));
    const auto at_cone = [&](Halfedge spoke) {
      return chart_of_pinned(map_.corner_of[cone].corner, map_.chart[spoke](before));
    };
    const Halfedge first = rest->slices.front().spoke;
    const Halfedge last = rest->slices.back().spoke;
    const auto chart = [&](const Fan::Slice& slice) { return composed(inverse(slice.into_fan), place->into_fan); };
    if (removal.left >= 0) {
      set_charts(removal.left, {at_cone(last), chart(rest->slices.back()), map_.chart[previous_in_triangle(last)]});
    }
    if (removal.right >= 0) {
      set_charts(removal.right, {chart(rest->slices.front()), at_cone(first), map_.chart[next_in_triangle(first)]});
    }
    for (const Fan::Slice& slice : hole.slices) map_.chart[slice.spoke] = at_cone(slice.spoke);
    for (const Fan::Slice& slice : rest->slices) map_.chart[slice.spoke] = chart(slice);
    undo_removal(map_.mesh, removal);
    unpin(map_, u);
    set_home(map_, u, place->home, place->at);
    pin_to(map_, removal.vertex, cone);
    return true;
  }

  /// Of the triangle of h, from its start on.
  void set_charts(Halfedge h, const std::array<UnitMotion, 3>& charts) {
    map_.chart[h] = charts[0];
    map_.chart[next_in_triangle(h)] = charts[1];
    map_.chart[previous_in_triangle(h)] = charts[2];
  }

  WorkingMap& map_;
  Wedges wedges_;
};

std::size_t count_vertices(const WorkingMap& map) {
  return map.home.size() - static_cast<std::size_t>(std::count(map.home.begin(), map.home.end(), -1));
}

std::size_t count(const Blocks& blocks) {
  std::size_t sum = 0;
  for (const auto& block : blocks) sum += block.size();
  return sum;
}

std::size_t count(const Hierarchy& hierarchy) {
  std::size_t sum = hierarchy.coarser.size();
  for (const Blocks& round : hierarchy.rounds) sum += count(round);
  return sum;
}

/// The last `number` of the removals, which leave the list. \return whether each found a place
bool put_back_last(WorkingMap& map, std::vector<Removal>& removals, std::size_t number) {
  Refinement refinement(map);
  for (; number > 0 && !removals.empty(); --number, removals.pop_back()) {
    if (!refinement.put_back(removals.back())) return false;
  }
  return true;
}

/// The same share of every block, about `number` in all.
bool put_back_last(WorkingMap& map, Blocks& blocks, std::size_t number) {
  const double share = static_cast<double>(number) / static_cast<double>(count(blocks));
  std::vector<char> done(blocks.size(), 0);
  for_each_index(blocks.size(), true, [&](std::size_t b) {
    const double part = std::ceil(share * static_cast<double>(blocks[b].size()));
    done[b] = put_back_last(map, blocks[b], static_cast<std::size_t>(part));
  });
  return std::find(done.begin(), done.end(), 0) == done.end();
}

/// At least `number` of the removals, the last ones; of all that are left at most.
bool put_back_last(WorkingMap& map, Hierarchy& hierarchy, std::size_t number) {
  const auto put_back = [&](auto& removals, std::size_t available) {
    const std::size_t part = std::min(number, available);
    number -= part;
    return put_back_last(map, removals, part);
  };
  if (!put_back(hierarchy.coarser, hierarchy.coarser.size())) return false;
  while (number > 0 && !hierarchy.rounds.empty()) {
    Blocks& blocks = hierarchy.rounds.back();
    const std::size_t available = count(blocks);
    if (available > 0 && !put_back(blocks, available)) return false;
    if (count(blocks) == 0) hierarchy.rounds.pop_back();
  }
  return true;
}

/// Levels are settled well, for what is left undone on one is spread over twice as many edges on the next; cones, which
/// were settled on the level before, have to look for their best place among its new vertices only.
constexpr double kTolerance = 1e-3;
constexpr int kStepsOfCones = 1;

/// Relaxes the map after vertices were put back, and lets its cones crawl.
void settle_level(WorkingMap& map, int sweeps) {
  on_compact_copy(map, [&](WorkingMap& near) {
    const double fallen = relax_all(near, {sweeps, kTolerance});
    crawl_all(near, kStepsOfCones);
    return fallen;
  });
}

}  // namespace

bool refine(WorkingMap& map, std::vector<Removal> removals, const RefineOptions& options, const Progress& progress) {
  Hierarchy hierarchy;
  hierarchy.coarser = std::move(removals);
  return refine(map, std::move(hierarchy), options, progress);
}

bool refine(WorkingMap& map, Hierarchy hierarchy, const RefineOptions& options, const Progress& progress) {
  const std::size_t all = count_vertices(map) + count(hierarchy);
  for (std::size_t left = count(hierarchy); left > 0; left = count(hierarchy)) {
    const double now = static_cast<double>(all - left);
    map.listed = false;
    const auto number = static_cast<std::size_t>(std::ceil(now * (options.level_growth - 1) + 1));
    if (!put_back_last(map, hierarchy, number)) return false;
    measure_rest_shapes(map);
    const double coarseness = static_cast<double>(all) / static_cast<double>(all - count(hierarchy));
    settle_level(map, static_cast<int>(options.sweeps * std::sqrt(coarseness)));
    report(progress, "bringing the map to the mesh",
           1 - static_cast<double>(count(hierarchy)) / static_cast<double>(all));
  }
  return true;
}

}  // namespace lozenge
