// A hierarchy of the source mesh: vertices are removed one by one down to a small proxy, and put back one by one while
// the map is carried along.
//
// Not in the paper, which runs on the source mesh itself; the work of its local operations then grows faster than the
// mesh. On a proxy of some thousand triangles it is done in no time, and the domain it finds is as good: a domain of a
// hundred triangles is decided by the shape at that scale. A vertex is removed by collapsing a half-edge, so the
// proxy's vertices are the source's. Putting it back can't fold the map: the hole that it left is seen whole from the
// vertex that it was collapsed into, so points near that vertex see it whole as well.
#pragma once

#include <functional>
#include <vector>

#include "formats/progress.h"
#include "stages/parameterize/working_map.h"

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

/// A say in what is removed; empty functions agree to all.
struct RemovalGuard {
  std::function<bool(VertexId)> may_remove;
  std::function<bool(VertexId)> may_grow;  ///< may take a removed neighbour's triangles
  /// Called after a removal. \return false to take it back
  std::function<bool(const Removal&)> removed;
};

/// Removes vertices, shortest edges first, until `mesh` has about `triangles` triangles or no edge can be collapsed
/// without changing the topology or turning a triangle over in space. A vertex on a boundary is removed along it, where
/// the boundary is not sharp; and no edge is made that joins two vertices of the boundary through the inside, for its
/// image would lie on the domain's boundary wherever that is straight. \return the removals, in order
std::vector<Removal> simplify(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, std::int32_t triangles,
                              const RemovalGuard& guard = {});

/// The same for the edges that leave these vertices, shortest first, while they are shorter than `longest`.
std::vector<Removal> simplify_edges(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions,
                                    const std::vector<VertexId>& vertices, float longest, const RemovalGuard& guard);

/// Removals in blocks that don't touch one another, so that threads can go through them side by side.
using Blocks = std::vector<std::vector<Removal>>;

/// The removals of a hierarchy, in order: those of the finest levels in rounds of blocks, then those of the coarser
/// ones.
struct Hierarchy {
  std::vector<Blocks> rounds;
  std::vector<Removal> coarser;
};

/// The same of a large mesh on all threads: first in blocks, down to the edges that the proxy has, then in others, for
/// what lies where those met, then as a whole.
/// \param keep  vertices that are not removed
Hierarchy simplify_in_blocks(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, std::int32_t triangles,
                             const std::vector<VertexId>& keep = {});

/// Removes vertices under a map, until about `triangles` are left: the same, but no image is folded by it, and pinned
/// vertices stay.
std::vector<Removal> coarsen(WorkingMap& map, std::int32_t triangles);

/// Puts the last removed vertex back into the connectivity.
void undo_removal(HalfedgeMesh& mesh, const Removal& removal);

struct RefineOptions {
  double level_growth = 2;  ///< vertices are put back in levels, each this many times the one before
  int sweeps = 4;           ///< of relaxation after the finest level; more after the coarser ones, which cost less
};

/// Puts all removed vertices back, last first, each where it sees its neighbours' images unfolded, and relaxes the map
/// after every level; of a large map the lists of vertices are not kept. \throws Error(kInternal) where a vertex finds
/// no such place
void refine(WorkingMap& map, std::vector<Removal> removals, const RefineOptions& options, const Progress& progress);
void refine(WorkingMap& map, Hierarchy hierarchy, const RefineOptions& options, const Progress& progress);

}  // namespace lozenge
