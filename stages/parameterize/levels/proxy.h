// A coarse level of the mesh as a mesh of its own: the domain is searched for on some thousand triangles, whose arrays
// should not be as long as those of a scan of millions.
#pragma once

#include <vector>

#include "stages/parameterize/map/halfedge_mesh.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// What is enough, of the triangles that a mesh has for each of a domain's. A large domain follows the surface itself
/// and needs fewer to see its shape: 1 up to 200 domain triangles, beyond as the inverse of the square root.
double enough_triangles(double faces);

/// How large the meshes are that a domain is looked for on.
struct ProxySize {
  double triangles_per_face = 40;  ///< before `enough_triangles`; 0: the whole mesh
  double least = 2000;

  /// For a domain of so many triangles.
  double triangles_for(double faces) const;
};

struct Proxy {
  std::vector<Vec3f> positions;
  HalfedgeMesh mesh;
  std::vector<VertexId> vertices;     ///< [vertex of the proxy] its number in the whole mesh
  std::vector<TriangleId> triangles;  ///< [triangle of the proxy] the same; corners are in the same order

  /// The number in the whole mesh of one of the proxy's half-edges; -1 of none.
  Halfedge in_whole(Halfedge h) const { return h < 0 ? -1 : 3 * triangles[h / 3] + h % 3; }
};

/// What is left of a simplified mesh, numbered without gaps.
Proxy extract_proxy(const HalfedgeMesh& simplified, const std::vector<Vec3f>& positions);

/// Puts what has been done to the proxy's mesh since it was extracted back into the mesh that it was taken from.
void write_back(const Proxy& proxy, HalfedgeMesh& simplified);

/// The map of a proxy as that of the simplified mesh it was taken from, ready to be refined. `positions` must outlive
/// it.
WorkingMap map_of_simplified(const WorkingMap& map, const Proxy& proxy, HalfedgeMesh simplified,
                             const std::vector<Vec3f>& positions);

}  // namespace lozenge
