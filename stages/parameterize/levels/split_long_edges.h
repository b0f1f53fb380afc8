// A finer triangulation of the same surface, where its triangles are large beside the domain's.
//
// The map is linear on a source triangle, and a triangle's image must lie in one star of the domain (paper, Sec. 4.1).
// A source triangle as long as a domain triangle leaves the map no freedom, and a longer one fits no star at all. Such
// triangles are split: new vertices lie on the source's edges, so the surface stays what it was.
#pragma once

#include <vector>

#include "formats/surface/source_mesh.h"
#include "stages/parameterize/map/halfedge_mesh.h"

namespace lozenge {

/// Splits edges in their middles, longest first, until none is longer than `longest` (in the mesh's units) or another
/// split would make more than `most_triangles`. Far from the origin, where coordinates are coarse beside an edge, it
/// stays as long as it is: its middle would lie off it. Attributes are interpolated; the result is in canonical form.
/// \param number_of  where not null, [vertex of `mesh`] its number in the result
SourceMesh split_long_edges(const SourceMesh& mesh, double longest, std::int64_t most_triangles,
                            std::vector<VertexId>* number_of = nullptr);

/// Splits every edge that joins two vertices of the boundary through the inside, in its middle; the same otherwise.
/// Where the boundary of the domain is straight between the images of two such vertices, the image of the edge would
/// lie on it.
SourceMesh split_chords(const SourceMesh& mesh, std::vector<VertexId>* number_of = nullptr);
bool has_chord(const HalfedgeMesh& mesh);

/// Splits these edges in their middles, in this order, each as `split_edge` does; not in canonical form.
SourceMesh split_edges(const SourceMesh& mesh, const std::vector<Halfedge>& edges);

/// The middle of an edge, as near to it as coordinates can be given; both ways the same.
Vec3f middle_of_edge(const Vec3f& a, const Vec3f& b);

/// Whether any edge is longer than `longest`.
bool has_longer_edge(const SourceMesh& mesh, double longest);

}  // namespace lozenge
