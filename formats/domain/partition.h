// The three partitions of the domain (paper, Sec. 4.2).
#pragma once

#include <array>
#include <cstdint>

#include "formats/domain/domain.h"
#include "formats/domain/domain_point.h"

namespace lozenge {

/// Into its triangles; into the half-diamonds of its edges, rhombi between the edge's ends and the barycentres beside
/// it; into the half-stars of its vertices, polygons through the barycentres around it. No point is near the border of
/// its part in all three.
enum class Partition { kFaces, kHalfDiamonds, kHalfStars };

/// The part that holds a place of a triangle, from its barycentric coordinates: the triangle itself; the half-diamond
/// of the side opposite the corner with the smallest coordinate; or the half-star of the corner with the largest. Of
/// equal coordinates, the first decides.
/// \return its number: of the triangle; of the edge, as 3 * triangle + side of its lower side; of the vertex
std::int32_t part_of(const Domain& domain, DomainTriangleId triangle, const std::array<double, 3>& weights,
                     Partition partition);
std::int32_t part_of(const Domain& domain, const DomainPoint& p, Partition partition);

}  // namespace lozenge
