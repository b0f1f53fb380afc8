// Where the surface ends: its boundary maps onto the domain's, side by side.
//
// A source vertex on the boundary lies on a side without a neighbour, exactly, and its home is that side's triangle; it
// has one degree of freedom, along the side, and slides over the domain vertices between sides that go straight on
// (three triangles around them). Wherever the domain's boundary bends a source vertex is pinned, as at a cone inside.
#pragma once

#include <optional>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// A place on the domain's boundary: a side without a neighbour, and how far along it.
struct BoundaryPlace {
  DomainSide side;
  double along = 0;
};

/// Where a place that has left its side lies, on the sides that go straight on; `back` takes the frame of its triangle
/// into that of the side it has left. \return nothing where the boundary bends before
struct SlideEnd {
  BoundaryPlace place;
  UnitMotion back;
};
std::optional<SlideEnd> slide(const Domain& domain, BoundaryPlace from);

/// Its position in the frame of the side's triangle.
Vec2d position_of(const BoundaryPlace& place);
/// The side's direction, of length 1, in the frame of its triangle.
Vec2d direction_of(int side);

/// The side that a free vertex of the boundary lies on. \param at  where in its home
/// \pre the home has a side without a neighbour: whatever gives a boundary vertex another home sees to it
BoundaryPlace boundary_place(const WorkingMap& map, VertexId v, const Vec2d& at);
inline BoundaryPlace boundary_place(const WorkingMap& map, VertexId v) { return boundary_place(map, v, map.at[v]); }

/// Moves a free vertex of the boundary to a point of its home's frame on the line of its side, and on to another home
/// where that lies beyond. \return false, with nothing changed, where the boundary bends before
bool slide_to(WorkingMap& map, VertexId v, const Vec2d& to);

/// A free vertex of the boundary that lies in a domain triangle's corner gets the triangle for its home whose side
/// leaves the corner along the boundary.
void move_to_first_of_fan(WorkingMap& map, VertexId v, DomainCorner corner);

/// The place on the boundary between two of its vertices, so far from the first one, and its chart.
/// \param h  of the half-edge on the boundary that runs from the first vertex to the second
/// \param share  of the way between their images
struct PlaceBetween {
  BoundaryPlace place;
  UnitMotion into_triangle;  ///< from the frame of the place's triangle into that of the triangle of `h`
};
std::optional<PlaceBetween> place_between(const WorkingMap& map, Halfedge h, double share);

/// The half-edge on the boundary that leaves the vertex, and the one that arrives there. \pre it lies on the boundary
inline Halfedge leaving_on_boundary(const HalfedgeMesh& mesh, VertexId v) { return mesh.outgoing[v]; }
inline Halfedge arriving_on_boundary(const HalfedgeMesh& mesh, VertexId v) {
  return previous_in_triangle(last_of_fan(mesh, mesh.outgoing[v]));
}

}  // namespace lozenge
