// Samples on the surface's boundary, moved along it into its corners.
//
// Samples lie on a regular grid, and a boundary with corners between them would be cut short there. Inside a half
// patch's diagonal each sample may slide along the boundary by less than a step, into one of the source's own vertices.
#pragma once

#include <optional>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/domain/source_locator.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// The vertices of the source's boundary, by where they lie along the domain's.
class BoundaryCorners {
 public:
  /// Keeps a reference to `mesh`.
  BoundaryCorners(const SourceMesh& mesh, const Parameterization& map);

  /// Where samples that lie along one side of the domain go: the choice, of a corner within reach or none for each,
  /// whose polyline leaves the boundary's vertices least far off.
  /// \param along  [sample] shares of the way along the side, ascending \param regular  [sample] their positions
  /// \return [sample] the corner that it slides into; nothing where it stays, as the first and the last do
  std::vector<std::optional<SourcePoint>> places(DomainSide side, const std::vector<double>& along,
                                                 const std::vector<Vec3f>& regular) const;

 private:
  struct Corner {
    double along = 0;  ///< the side
    SourcePoint source;
  };
  const SourceMesh& mesh_;
  std::vector<std::vector<Corner>> on_side_;  ///< [3 * domain triangle + side], ascending
};

/// A place on the boundary: its side, and how far along.
struct PlaceOnSide {
  DomainSide side;
  double along = 0;
};
/// \return nothing where the place lies on no side without a neighbour, or in a corner
std::optional<PlaceOnSide> place_on_boundary(const Domain& domain, const DomainPoint& p);

}  // namespace lozenge
