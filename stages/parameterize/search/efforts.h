// How much optimization goes into which step of the search.
//
// Set by trial, as bounds on the time of each step; docs/parameterization.md has what was tried and dropped. What they
// leave undone, the final optimization does.
#pragma once

#include "stages/parameterize/relax/global_optimization.h"

namespace lozenge {

/// Where an epoch brings less than this share of what is above an isometry, the search goes on.
inline constexpr double kRough = 1e-2;

/// To compare domains by the energy of the whole map: as far as that tells them apart.
inline GlobalOptions effort_to_judge(bool at_once) {
  return {.most_epochs = 3, .tolerance = 2e-2, .at_once = at_once, .cones = Cones::kInTheirStars};
}
/// A whole map judged so counts as better where it is by more than this share of what is above an isometry.
inline constexpr double kLeastGainOfFlip = 1e-3;

/// Of a domain that is to be improved by flips.
inline GlobalOptions effort_before_flips(int epochs) {
  return {.most_epochs = epochs, .tolerance = kRough, .cones = Cones::kInTheirStars};
}

/// While the domain shrinks, and everything will move again.
inline GlobalOptions effort_on_the_way(int epochs, bool at_once, Cones cones) {
  return {.most_epochs = epochs, .tolerance = kRough, .sweeps = 4, .at_once = at_once, .cones = cones};
}

/// After a vertex was moved: cones near what was changed have moved already.
inline GlobalOptions effort_after_moves(int epochs) {
  return {.most_epochs = epochs, .tolerance = kRough, .cones = Cones::kStay};
}

}  // namespace lozenge
