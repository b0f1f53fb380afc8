// A triangle spanned by three positions on the domain (paper, Sec. 4.1), laid out flat.
//
// The paper spans it in a face domain, else in a diamond domain, else in a star domain. We do the same, but the
// star is unfolded rigidly around its vertex instead of being squeezed into a regular polygon: that needs a source
// vertex at every irregular domain vertex (a cone), so that no triangle has a cone inside, and in return every triangle
// has an exact, flat image, and the images tile the domain exactly.
#pragma once

#include <array>
#include <optional>

#include "formats/domain/domain.h"
#include "formats/domain/domain_point.h"

namespace lozenge {

/// Which interpolation domain holds a triangle.
enum class Span { kFace, kDiamond, kStar };

/// Three positions in one frame.
struct Development {
  Span span = Span::kFace;
  /// The triangle whose frame the corners are in. An image of positive area has some of it in common with its home.
  DomainTriangleId home = -1;
  std::array<LatticePoint, 3> corners{};  ///< they may lie outside the home triangle
};

/// The flat image of the triangle with these three corners: in a face domain where one holds all three, else in a
/// diamond, else in a star unfolded around its vertex. Positions on a side or in a corner count as lying in each
/// triangle there. Where several unfoldings are possible (around a vertex of few triangles), one of positive area is
/// taken, and of those the one with the shortest edges.
/// \return nothing where no star holds all three positions, or where only an unfolding with a cone inside exists
std::optional<Development> develop(const Domain& domain, const std::array<DomainPoint, 3>& points);

/// The corner of `triangle` that the point coincides with, or -1.
int corner_at(const DomainPoint& p);

/// The domain vertex that the point coincides with, or -1.
DomainVertex vertex_at(const Domain& domain, const DomainPoint& p);

}  // namespace lozenge
