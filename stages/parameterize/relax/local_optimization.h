// Local optimization (paper, Sec. 5.2): moves the images of source vertices so that the energy (paper, eq. 4) falls,
// never folding a triangle.
//
// The paper hands each interpolation domain to a black box. Here a vertex moves by one step of Newton's method on the
// energy of the triangles around it, in its own frame, all other vertices held; going over the vertices again and again
// is a nonlinear Gauss-Seidel method. A step ends before the first triangle would turn over and is halved until the
// energy falls, so the energy never rises and the map stays without folds.
#pragma once

#include <optional>
#include <vector>

#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/wedge.h"

namespace lozenge {

/// One step of vertex `v`. Pinned vertices stay. \param wedges  is filled with the triangles around it
/// \return by how much the energy fell: 0 where nothing was done
double relax_vertex(WorkingMap& map, VertexId v, Wedges& wedges);

/// The same of a free vertex, which keeps its home even where it leaves it, so that nothing but its own position is
/// written. \param scale  the map's \param excess  grows by what the energy around was above that of an isometry
double relax_at_home(WorkingMap& map, VertexId v, double scale, Wedges& wedges, double& excess);

struct RelaxOptions {
  int most_sweeps = 20;
  /// Stops where a sweep lowers the energy by less than this share of what it is above an isometry's.
  double tolerance = 1e-2;
};

/// Around a collapse or a flip: five sweeps settle what it has changed to a hundredth, which tells one operation from
/// another; what reaches further, the epochs that follow see to. Set by trial, as all efforts of the search
/// (`efforts.h`).
inline constexpr RelaxOptions kRelaxAround{5, 1e-2};

/// Sweeps over `vertices` in order, there and back. \return by how much the energy fell
double relax(WorkingMap& map, const std::vector<VertexId>& vertices, const RelaxOptions& options);

/// Turns back folded triangles around `vertices` (paper, Sec. 5.6): moves each vertex that has one among its triangles
/// into the kernel of the triangles around it, or else to their mean, for a few rounds. \return whether none is left
/// among the triangles around them
bool heal_folds(WorkingMap& map, const std::vector<VertexId>& vertices);

/// Moves each of the unpinned vertices into the middle of the kernel of the triangles around it, where it has one: to
/// the map least distorted it is not, but furthest from a fold.
void move_into_kernels(WorkingMap& map, const std::vector<VertexId>& vertices);

}  // namespace lozenge
