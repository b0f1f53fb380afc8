// Places beyond the border of a patch, as the gutters of an atlas show them: the neighbour's square, bent across the
// border. As far behind it as a place of the one lies before it, the other has the same place.
#pragma once

#include <array>
#include <cstdint>

#include "formats/base/vector.h"
#include "formats/patches/patch_layout.h"

namespace lozenge {

/// A place (u, v) of a patch, seen from one of its sides.
struct BorderPlace {
  double along = 0;  ///< 0..1 from the side's start to its end
  double depth = 0;  ///< to the inside; negative beyond the border
};

inline BorderPlace seen_from_side(int side, const Vec2d& place) {
  switch (side) {
    case 0:
      return {place.x, place.y};
    case 1:
      return {place.y, 1 - place.x};
    case 2:
      return {1 - place.x, 1 - place.y};
    default:
      return {1 - place.y, place.x};
  }
}

inline Vec2d place_at_side(int side, const BorderPlace& place) {
  switch (side) {
    case 0:
      return {place.along, place.depth};
    case 1:
      return {1 - place.depth, place.along};
    case 2:
      return {1 - place.along, 1 - place.depth};
    default:
      return {place.depth, 1 - place.along};
  }
}

/// What a place of the patch is called by the one across `side`, whose side `other` coincides with it: neighbouring
/// sides run against each other.
inline Vec2d across_border(int side, const Vec2d& place, int other) {
  const BorderPlace here = seen_from_side(side, place);
  return place_at_side(other, {1 - here.along, -here.depth});
}

}  // namespace lozenge
