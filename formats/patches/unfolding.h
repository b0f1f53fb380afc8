// The domain laid out flat under the image of a source triangle (paper, Sec. 4.1), and the patches that lie there
// (Sec. 4.2).
#pragma once

#include <vector>

#include "formats/domain/development.h"
#include "formats/domain/domain.h"
#include "formats/domain/domain_point.h"

namespace lozenge {

/// A domain triangle that an image has area in common with.
struct UnfoldedTriangle {
  DomainTriangleId triangle = -1;
  LatticeMotion into_home;  ///< from its frame into that of the image's home
};

/// All of them, the home first. The same triangle may be there twice where the image reaches around a cone.
/// \pre  the image has positive area and no cone inside
std::vector<UnfoldedTriangle> unfold(const Domain& domain, const Development& image);

/// From the frame of a domain triangle into that of the patch on its side: the patch's edge runs from a = (0, 0) to b =
/// (kLatticeOne, 0), its left triangle lies above.
LatticeMotion into_patch(int side, bool left);

/// Where a point of a patch's frame lies in its square, in lattice steps: the square is 0..kLatticeOne each way. (The
/// frame's axes are 60 degrees apart; the barycentres are thirds. So u = x - y and v = x + 2 y, exactly.)
inline LatticePoint in_square(LatticePoint p) { return {p.u - p.v, p.u + 2 * p.v}; }

}  // namespace lozenge
