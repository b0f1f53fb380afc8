// Simplification by collapses of half-edges, the shortest first.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "stages/parameterize/levels/removal.h"

namespace lozenge {

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

}  // namespace lozenge
