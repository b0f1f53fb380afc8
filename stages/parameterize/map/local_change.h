// A change of a map around one place, all of it or nothing: the transaction behind collapses, flips, splits, cones that
// move and vertices that are anchored.
//
// All of them go alike: find out how the map hangs together around a region of the domain, keep what will be changed,
// rewire the domain, lay the surface out and back, heal and relax, compare the energy with what it was, and let that
// stay or take it back. What isn't committed is taken back when the transaction ends, so what an operation would cost
// is asked by carrying it out and not committing it.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "stages/parameterize/map/scratch.h"
#include "stages/parameterize/map/surroundings.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

class LocalChange {
 public:
  LocalChange(WorkingMap& map, Scratch& scratch) : map_(map), scratch_(scratch), faces_(map.domain_faces) {}
  LocalChange(const LocalChange&) = delete;
  LocalChange& operator=(const LocalChange&) = delete;
  ~LocalChange() { take_back(); }

  WorkingMap& map() { return map_; }
  Scratch& scratch() { return scratch_; }

  /// Finds the region's surroundings and keeps what moves in it. \return false, with nothing kept, where the charts
  /// don't tell how the map hangs together there
  bool open(const Region& region);
  /// Of the region that was opened.
  const std::vector<MovingTriangle>& surroundings() const { return surroundings_; }

  /// Keeps these vertices, and the charts of the triangles around them, whose energies are what is compared from now
  /// on.
  void keep_around(const std::vector<VertexId>& vertices);
  /// Keeps a vertex and the charts of the triangles around it.
  void keep_vertex(VertexId v);
  /// Keeps a domain vertex: where it is, and which vertex is pinned to it (but not where that one lies).
  void keep_domain_vertex(DomainVertex n) { corners_.push_back({n, map_.corner_of[n], map_.anchor[n]}); }
  /// The same, and where the vertex lies that is pinned to it.
  void keep_anchored(DomainVertex n);
  /// Keeps a domain triangle's corners and neighbours.
  void keep_triangle(DomainTriangleId t) { triangles_.emplace_back(t, map_.domain.triangles[t]); }
  /// The same, and its neighbours.
  void keep_triangle_and_neighbours(DomainTriangleId t);

  /// Notes the energy that what comes will be compared with: that of the map as it is, by the scale that a domain of so
  /// many triangles has.
  void measure_before(std::int32_t faces);
  void measure_before() { measure_before(map_.domain_faces); }
  double before() const { return before_; }
  /// Of the same triangles, now.
  double energy() const;
  double rise() const { return energy() - before_; }
  /// The charts of these triangles agree with one another and with the domain.
  bool is_sound() const;

  /// Carries out the first of some candidates that goes well: `attempt(candidate)` changes the map, and says whether
  /// that may stay; where not, it is taken back. \return false, with nothing changed, where none goes well
  template <typename Candidates, typename Attempt>
  bool carry_out_first(const Candidates& candidates, Attempt&& attempt) {
    for (const auto& candidate : candidates) {
      if (attempt(candidate)) return true;
      restore();
    }
    forget();
    return false;
  }

  /// Puts back what was kept, as it was first; it stays kept, for another attempt.
  void restore();
  /// Puts it back, and ends.
  void take_back();
  /// What was changed stays.
  void commit() { forget(); }

 private:
  struct KeptCorner {
    DomainVertex vertex;
    DomainCorner corner;
    VertexId anchor;
  };
  struct KeptVertex {
    VertexId vertex;
    DomainTriangleId home;
    Vec2d at;
    DomainVertex pin;
  };
  struct KeptCharts {
    TriangleId triangle;
    std::array<UnitMotion, 3> charts;
  };

  void keep_place(VertexId v) { vertices_.push_back({v, map_.home[v], map_.at[v], map_.pin[v]}); }
  void keep_charts(TriangleId t) {
    charts_.push_back({t, {map_.chart[3 * t], map_.chart[3 * t + 1], map_.chart[3 * t + 2]}});
  }
  void forget();

  WorkingMap& map_;
  Scratch& scratch_;
  std::int32_t faces_;
  std::vector<MovingTriangle> surroundings_;
  std::vector<TriangleId> compared_;
  double before_ = 0;
  std::vector<std::pair<DomainTriangleId, DomainTriangle>> triangles_;
  std::vector<KeptCorner> corners_;
  std::vector<KeptVertex> vertices_;
  std::vector<KeptCharts> charts_;
};

/// Carries an operation out: `operation(change)` says by its result whether it went well. \return the result
template <typename Operation>
auto carry_out(WorkingMap& map, Scratch& scratch, Operation&& operation) {
  LocalChange change(map, scratch);
  auto result = operation(change);
  if (result) change.commit();
  return result;
}

/// What the operation would give, tried out and taken back. The map is what it was, but for the order of its lists and
/// for vertices that were anchored to make room.
template <typename Operation>
auto on_trial(WorkingMap& map, Scratch& scratch, Operation&& operation) {
  LocalChange change(map, scratch);
  return operation(change);
}

}  // namespace lozenge
