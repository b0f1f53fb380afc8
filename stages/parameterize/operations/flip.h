// Edge flips on the abstract domain (paper, Sec. 5.4).
#pragma once

#include <optional>

#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

/// Both ends keep 3 triangles or more, and the flipped edge doesn't exist yet.
bool can_flip(const WorkingMap& map, DomainSide side);

/// Length on the surface that flipping `side` would save (paper, eq. 3), in the units of the source mesh. Paths are
/// measured on the mesh (Sec. 5.7), not in space.
double flip_gain(const WorkingMap& map, const SurfaceMeasures& measures, DomainSide side);

/// Flips the side and carries every vertex at home in its two triangles along, through their diamond domain; then
/// relaxes the map over the stars of the four vertices around. The side's triangle and number now stand for the flipped
/// edge. \pre can_flip \return by how much the energy of the four stars rose (less than 0 where it fell); nothing, with
/// nothing changed (but that the four vertices may have been anchored), where the flip would fold the map
std::optional<double> flip(WorkingMap& map, DomainSide side, const RelaxOptions& options, Scratch& scratch);

/// The same, but refused as well where it doesn't lower the energy.
std::optional<double> flip_if_better(WorkingMap& map, DomainSide side, const RelaxOptions& options, Scratch& scratch);

/// By how much a flip makes the valences of the four vertices more even: half of what the sum of their squares falls
/// by.
int evenness_gain(const WorkingMap& map, DomainSide side);

}  // namespace lozenge
