// A hierarchy of the source mesh: vertices are removed one by one down to a small proxy, and put back one by one while
// the map is carried along.
//
// Not in the paper, which runs on the source mesh itself; the work of its local operations then grows faster than the
// mesh. On a proxy of some thousand triangles it is done in no time, and the domain it finds is as good: a domain of a
// hundred triangles is decided by the shape at that scale. A vertex is removed by collapsing a half-edge, so the
// proxy's vertices are the source's. Putting it back can't fold the map: the hole that it left is seen whole from the
// vertex that it was collapsed into, so points near that vertex see it whole as well.
#pragma once

#include <vector>

#include "stages/parameterize/map/halfedge_mesh.h"

namespace lozenge {

/// One removed vertex: the edge that was collapsed, whose triangles are gone (their arrays keep what is needed to come
/// back). An edge on a boundary has one of its two half-edges only.
struct Removal {
  Halfedge left = -1;   ///< from the removed vertex to the one that it was collapsed into
  Halfedge right = -1;  ///< its twin
  VertexId vertex = -1;

  std::int32_t triangles() const { return (left >= 0) + (right >= 0); }
};

/// What a removal leaves behind: the fan of triangles that the removed vertex had, from the half-edge `first` to the
/// half-edge `last`, which now leave the vertex that it was collapsed into. \pre nothing was removed since
struct Hole {
  Halfedge first = -1;
  Halfedge last = -1;
};
Hole hole_of(const HalfedgeMesh& mesh, const Removal& removal);

/// The vertices opposite the edge that was or is to be collapsed; -1 beyond a boundary.
struct OppositeCorners {
  VertexId left = -1;
  VertexId right = -1;
};
/// \pre the removal's triangles are there
OppositeCorners opposite_corners(const HalfedgeMesh& mesh, const Removal& removal);
/// The vertex that the removal's vertex is collapsed into. \pre the removal's triangles are there
VertexId end_of(const HalfedgeMesh& mesh, const Removal& removal);

/// Takes the vertex out of the connectivity. \pre that changes no topology
void remove_vertex(HalfedgeMesh& mesh, const Removal& removal);
/// Puts the last removed vertex back into the connectivity.
void undo_removal(HalfedgeMesh& mesh, const Removal& removal);

/// Removals in blocks that don't touch one another, so that threads can go through them side by side.
using Blocks = std::vector<std::vector<Removal>>;

/// The removals of a hierarchy, in order: those of the finest levels in rounds of blocks, then those of the coarser
/// ones.
struct Hierarchy {
  std::vector<Blocks> rounds;
  std::vector<Removal> coarser;
};

}  // namespace lozenge
