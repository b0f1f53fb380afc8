// Triangles are found from the home over the sides that the image crosses: a side is crossed where the image has points
// on both of its ends' lines, which is asked in integers. Nothing is found over a corner, so the layout never turns
// about a cone.
#include "formats/patches/unfolding.h"

#include <algorithm>
#include <array>

namespace lozenge {

namespace {

using Corners = std::array<LatticePoint, 3>;

/// Whether the inside of a triangle (counter-clockwise) and that of a segment have a point in common: no side of either
/// parts them.
bool crosses(const Corners& triangle, LatticePoint from, LatticePoint to) {
  for (int i = 0; i < 3; ++i) {
    const LatticePoint a = triangle[i];
    const LatticePoint b = triangle[(i + 1) % 3];
    if (doubled_area(a, b, from) <= 0 && doubled_area(a, b, to) <= 0) return false;
  }
  bool left = false;
  bool right = false;
  for (const LatticePoint p : triangle) {
    const LatticeArea side = doubled_area(from, to, p);
    left = left || side > 0;
    right = right || side < 0;
  }
  return left && right;
}

bool is_there(const std::vector<UnfoldedTriangle>& found, const UnfoldedTriangle& t) {
  return std::any_of(found.begin(), found.end(), [&](const UnfoldedTriangle& other) {
    return other.triangle == t.triangle && other.into_home.shift == t.into_home.shift &&
           other.into_home.sixths == t.into_home.sixths;
  });
}

}  // namespace

std::vector<UnfoldedTriangle> unfold(const Domain& domain, const Development& image) {
  // An image is no longer than a star is wide; this is never reached.
  constexpr std::size_t kMost = 64;
  static constexpr Corners kFrame{LatticePoint{0, 0}, LatticePoint{kLatticeOne, 0}, LatticePoint{0, kLatticeOne}};
  std::vector<UnfoldedTriangle> found{{image.home, {}}};
  for (std::size_t next = 0; next < found.size() && found.size() < kMost; ++next) {
    const UnfoldedTriangle here = found[next];
    for (int side = 0; side < 3; ++side) {
      const DomainSide across = domain.neighbour({here.triangle, side});
      if (!across.exists()) continue;
      if (!crosses(image.corners, here.into_home(kFrame[side]), here.into_home(kFrame[(side + 1) % 3]))) continue;
      const UnfoldedTriangle there{across.triangle, composed(here.into_home, transition(side, across.side))};
      if (!is_there(found, there)) found.push_back(there);
    }
  }
  return found;
}

LatticeMotion into_patch(int side, bool left) {
  // The right triangle's side runs from b to a.
  static constexpr LatticeMotion kHalfTurn{3, {kLatticeOne, 0}};
  return left ? corner_frame(side) : composed(kHalfTurn, corner_frame(side));
}

}  // namespace lozenge
