// Undoing splits: once there is a map, most of what was split to find it can be whole again.
//
// Edges are split so that triangles are small beside the domain's while it is looked for (`split_long_edges`): cones
// need vertices to lie on, and a triangle that is longer than a star has no image. A finished map needs only the
// latter, and the source comes out as it went in wherever that costs little.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Numbers the triangles in a stream of the mesh's attributes, so that splitting can be undone.
void number_triangles(SourceMesh& mesh);
/// Takes the stream away again.
void forget_numbers(SourceMesh& mesh);

/// Takes vertices out of triangles that have been numbered and split since, each by collapsing it along an edge of the
/// triangle that it lies on (or into any vertex around, where it lies inside): the surface and its attributes stay what
/// they are. So does the map's exactness: the images of the triangles around stay without folds, fit their neighbours,
/// and fill the same place. Images of all other vertices stay where they are. Not in canonical form then.
/// \param may_go  [vertex] those that splitting put in
/// \param most_worse  what one vertex may cost: the rise of the distortion (the sum of 3 times that of areas and that
/// of angles) times the surface's area \return how many vertices went
std::int64_t take_out_splits(SourceMesh& mesh, Parameterization& map, const std::vector<char>& may_go,
                             double most_worse);

}  // namespace lozenge
