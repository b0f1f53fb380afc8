// Areas of regions and lengths of paths, measured on the mesh through the map (paper, Sec. 5.7), and estimated in space
// while regions hold too few vertices to measure (5.7.1).
#pragma once

#include <vector>

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// What the measures need besides the map.
struct SurfaceMeasures {
  std::vector<float> vertex_area;  ///< [source vertex] of its Voronoi region
  std::vector<Vec3d> embedding;    ///< [domain vertex] position in space, while the domain is not yet abstract
  bool warming_up = true;          ///< false once every region holds more than kWarmVertices vertices
};

/// H_min of the paper: regions of fewer vertices are estimated in space, in part.
inline constexpr int kWarmVertices = 15;

/// Area of each vertex's Voronoi region; an obtuse triangle gives half of its area to the obtuse corner and a quarter
/// to the others.
std::vector<float> voronoi_areas(const WorkingMap& map);

/// Area of the region theta(D_t): the Voronoi areas of the vertices at home there, blended with the area of the
/// embedded triangle while they are fewer than kWarmVertices.
double region_area(const WorkingMap& map, const SurfaceMeasures& measures, DomainTriangleId t);

/// Length of the path theta(e) by equation (5), blended with the distance of the embedded end points in the same way.
double path_length(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

/// The same of the path that would join the two corners opposite the side, through its diamond.
double flipped_path_length(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

}  // namespace lozenge
