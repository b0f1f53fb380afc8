// Newton's method on all vertices at once (paper, Sec. 5.5, with all interpolation domains in one).
//
// Sweeps over single vertices settle what is between neighbours in no time, and what reaches over many edges, or over
// thin triangles, hardly at all. All transitions of the domain being rotations, the energy is an ordinary function of
// all positions, and Newton's method with a sparse factorization settles it in a few steps. Their cost grows faster
// than the mesh, so this is for levels of some ten thousand vertices.
#pragma once

#include "stages/parameterize/map/working_map.h"

namespace lozenge {

struct NewtonOptions {
  int most_steps = 20;
  /// Ends when a step lowers the energy by less than this share of its distance from 1, or by less than the share's
  /// square root and went all of its way: then the next one would gain the square of that.
  double tolerance = 1e-3;
};

/// Projected Newton steps of all free vertices; a step ends before a triangle turns over and is cut until the energy
/// falls. The cones stay. \return by how much the energy fell
double newton_all(WorkingMap& map, const NewtonOptions& options);

}  // namespace lozenge
