// What kind of surface a source mesh is: how its triangles hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/surface/source_mesh.h"

namespace lozenge {

struct SurfaceFacts {
  std::int64_t vertices = 0;
  std::int64_t triangles = 0;
  std::int64_t components = 0;
  std::int64_t euler = 0;           ///< vertices - edges + triangles, over all components
  std::int64_t boundary_loops = 0;  ///< closed lines of boundary edges; those that meet in a vertex count as one
  std::int64_t boundary_edges = 0;  ///< that belong to one triangle only
};

/// The half-edge 3 * t + s runs along side s of triangle t, from its corner s to its corner (s + 1) % 3.
using HalfEdge = std::int32_t;

inline VertexId half_edge_start(const SourceMesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][h % 3]; }
inline VertexId half_edge_end(const SourceMesh& mesh, HalfEdge h) { return mesh.triangles[h / 3][(h % 3 + 1) % 3]; }

/// What stands in for a twin where there isn't exactly one half-edge that runs along the same edge the other way.
inline constexpr HalfEdge kNoTwin = -1;       ///< no other half-edge joins the two vertices: the surface's boundary
inline constexpr HalfEdge kCrowdedTwin = -2;  ///< two or more others do
/// One other does, `other`, but it runs in the same direction. Its own inverse.
inline constexpr HalfEdge same_direction_twin(HalfEdge other) { return -3 - other; }
inline constexpr bool is_same_direction_twin(HalfEdge twin) { return twin <= -3; }

struct HalfEdgeLinks {
  std::vector<HalfEdge> twins;  ///< [half-edge] its twin, or what stands in for it
  std::int64_t edges = 0;       ///< pairs of vertices that a side joins
};

/// \pre every triangle's corners are distinct vertices of the mesh
HalfEdgeLinks link_half_edges(const SourceMesh& mesh);

/// Counts of any mesh, manifold or not. Triangles hang together where they share a vertex.
SurfaceFacts surface_facts(const SourceMesh& mesh);
SurfaceFacts surface_facts(const SourceMesh& mesh, const HalfEdgeLinks& links);

}  // namespace lozenge
