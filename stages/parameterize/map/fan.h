// Triangles around one vertex, laid out flat, and a place from which a vertex sees all of them.
//
// What a vertex needs that is put back where it was removed, or that a cone has left: its triangles' outline is then
// the fan around another vertex, which sees all of it, and so do points near that one.
#pragma once

#include <optional>
#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Triangles around one vertex u, from one half-edge that leaves it to another, in the frame of the first of them.
struct Fan {
  std::vector<Vec2d> outline;  ///< u, then the other corners counter-clockwise
  struct Slice {
    Halfedge spoke;       ///< leaves u
    UnitMotion into_fan;  ///< from the triangle's frame into the layout's
  };
  std::vector<Slice> slices;  ///< slice i lies between outline corners i + 1 and i + 2

  const Vec2d& centre() const { return outline.front(); }
};

/// The fan counter-clockwise from the triangle of `first` to that of `last`, which both leave one vertex.
Fan lay_out_fan(const WorkingMap& map, Halfedge first, Halfedge last);

/// Where a vertex is to be put: in the fan's layout, and as a home with the motion from there into the layout.
struct PlaceInFan {
  Vec2d in_fan;
  DomainTriangleId home = -1;
  Vec2d at;
  UnitMotion into_fan;
};

/// A place that sees the fan's whole outline: the wanted one, the middle of all of them, or one ever nearer to the
/// fan's centre, half-way between its two neighbours on the outline. \return nothing where the fan turns about its
/// centre by a full turn or more, so that nothing sees all of it but once
std::optional<PlaceInFan> find_place(const WorkingMap& map, const Fan& fan, const Vec2d& wanted);

/// Which way the boundary is followed from a vertex on it: as it runs, the surface on its left, or back.
enum class Along { kAhead, kBack };

/// The same on the boundary, which the fan's centre lies on: on the straight line to the neighbour there, the end of
/// the first spoke ahead or the last corner of the outline back, so far from the centre as a share of that line, or
/// nearer. \return nothing where the fan turns about its centre by half of a turn or more
std::optional<PlaceInFan> find_place_on_boundary(const WorkingMap& map, const Fan& fan, Along way, double share);

/// The mean of an outline's corners.
Vec2d mean_of(const std::vector<Vec2d>& outline);

}  // namespace lozenge
