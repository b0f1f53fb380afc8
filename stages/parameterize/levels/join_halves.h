// Undoing splits: once there is a map, most of what was split to find it can be whole again.
//
// Edges are split so that triangles are small beside the domain's while it is looked for (`split_long_edges`): cones
// need vertices to lie on, and a triangle that is longer than a star has no image. A finished map needs only the latter,
// and the source comes out as it went in wherever joining its halves again costs little.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Takes vertices out that lie in the middle of an edge whose triangles are the halves of others in every bit, as
/// splitting made them, and joins these, where the map stays without folds and exact: the joined triangles' images fill
/// the place of the halves'. Images of all other vertices stay where they are. Bring the mesh into canonical form then.
/// \param may_go  [vertex] those that splitting put in
/// \param most_worse  what the distortion (the sum of 3 times that of areas and that of angles) may rise by, on any
/// piece of the surface and so on all of it
/// \return how many vertices went
std::int64_t join_halves(SourceMesh& mesh, Parameterization& map, const std::vector<char>& may_go, double most_worse);

}  // namespace lozenge
