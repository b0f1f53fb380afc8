// How even a mesh is: the columns of the paper's Table 1 (Sec. 7.1.2), and its topology.
#pragma once

#include <cstdint>

#include "formats/surface/surface_view.h"

namespace lozenge {

/// How values spread around their mean; all but the mean in percent of it.
struct Spread {
  double mean = 0;
  double sigma = 0;  ///< standard deviation
  double min = 0;
  double max = 0;
};

struct MeshStatistics {
  std::int64_t vertices = 0;  ///< that some triangle uses
  std::int64_t edges = 0;
  std::int64_t triangles = 0;
  std::int64_t euler = 0;             ///< vertices - edges + triangles
  std::int64_t components = 0;        ///< joined through shared vertices
  std::int64_t boundary_edges = 0;    ///< with one triangle
  std::int64_t boundary_loops = 0;    ///< that those form; loops that meet in a vertex count as one
  std::int64_t tangled_edges = 0;     ///< with three or more triangles, or two that run along it in the same direction
  std::int64_t pinched_vertices = 0;  ///< whose triangles form more than one fan
  std::int64_t irregular_vertices = 0;  ///< of a valence other than 6; on the boundary, other than 3 triangles
  double irregular_percent = 0;         ///< of all vertices
  Spread area;                          ///< of the triangles, asset's units squared
  Spread edge;                          ///< lengths, asset's units
  double min_angle = 0;                 ///< over all wedges, radians
  double mean_min_angle = 0;            ///< mean over the triangles of each one's smallest angle, radians
};

/// \pre corners are indices into the positions
MeshStatistics mesh_statistics(const SurfaceView& surface);

/// Oriented and 2-manifold, perhaps with boundary: every edge has one triangle, or two that run along it in opposite
/// directions, and the triangles around every vertex form one fan.
inline bool is_manifold(const MeshStatistics& s) {
  return s.tangled_edges == 0 && s.pinched_vertices == 0 && s.triangles > 0;
}

/// Closed, oriented and 2-manifold: every edge has two triangles that run along it in opposite directions, and the
/// triangles around every vertex form one fan.
inline bool is_closed_manifold(const MeshStatistics& s) { return s.boundary_edges == 0 && is_manifold(s); }

}  // namespace lozenge
