// What kind of surface a source mesh is: how its triangles hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/source_mesh.h"

namespace lozenge {

struct SurfaceFacts {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t components = 0;
  std::int64_t euler = 0;  ///< vertices - edges + triangles, over all components
};

/// The half-edge 3 * t + s runs along side s of triangle t, from its corner s to its corner (s + 1) % 3.
using HalfEdge = std::int64_t;

inline VertexId half_edge_start(const SourceMesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][h % 3]; }
inline VertexId half_edge_end(const SourceMesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][(h % 3 + 1) % 3]; }

/// What is not a twin in the array of `half_edge_twins`.
inline constexpr HalfEdge kNoTwin = -1;       ///< no other half-edge joins the two vertices: the surface's boundary
inline constexpr HalfEdge kSameTwin = -2;     ///< one other does, but it runs in the same direction
inline constexpr HalfEdge kCrowdedTwin = -3;  ///< two or more others do

/// [half-edge] the half-edge of the neighbour that runs along the same edge in the opposite direction, or one of the
/// constants above where there isn't exactly one.
std::vector<HalfEdge> half_edge_twins(const SourceMesh& mesh);

/// Counts of any mesh, manifold or not. Triangles hang together where they share a vertex.
SurfaceFacts surface_facts(const SourceMesh& mesh);

}  // namespace lozenge
