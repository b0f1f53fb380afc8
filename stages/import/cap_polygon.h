// The triangles that close a polygon in space.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// Polygons of more sides are left to others: time grows with the third power of their number.
inline constexpr std::size_t kMostSidesOfCap = 100;

struct PolygonCap {
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< of the polygon's corners, running the polygon's way around
  double area = 0;
};

/// The triangulation of a polygon whose triangles have the least sum of their areas and a tenth of what equilateral
/// ones with such sides would have: small and well shaped. By dynamic programming over runs of corners (Barequet and
/// Sharir, "Filling gaps in the boundary of a polyhedron", Computer Aided Geometric Design 12, 1995). \param may_join
/// whether a diagonal may join two corners, the lower first; diagonals only \pre 3 to kMostSidesOfCap corners \return
/// nothing where all triangulations need a forbidden diagonal
std::optional<PolygonCap> cap_polygon(const std::vector<Vec3d>& corners,
                                      const std::function<bool(std::int32_t, std::int32_t)>& may_join);

}  // namespace lozenge
