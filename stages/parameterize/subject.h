// The surface that a map is looked for, made ready for it.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/surface/source_mesh.h"
#include "stages/parameterize/domain_size.h"
#include "stages/parameterize/map/halfedge_mesh.h"

namespace lozenge {

/// The surface that the map is of, and its connectivity.
struct Subject {
  SourceMesh mesh;
  HalfedgeMesh halfedges;  ///< of all of it, until a domain is looked for
  std::vector<VertexId> cones;
  std::vector<Vec3f> unsplit;  ///< positions of the source's own vertices, once edges were split

  void connect() { halfedges = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size())); }
  void become(SourceMesh split, const std::vector<VertexId>& number_of) {
    if (unsplit.empty()) unsplit = mesh.positions;
    mesh = std::move(split);
    for (VertexId& v : cones) v = number_of[v];
    connect();
  }
};

/// Numbers near what lies near in space, where the mesh's arrays are so long that it is far apart in memory else.
void number_along_curve(Subject& subject);

/// Splits what is too long beside the domain's triangles, and what would hold a domain's boundary on itself.
/// \param longest_edge  as a share of a domain triangle's side; 0: none is too long
void make_fine_enough(Subject& subject, const FaceRange& faces, double longest_edge);

}  // namespace lozenge
