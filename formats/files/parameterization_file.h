// SourceMesh and Parameterization <-> GLB: the mesh's own file with the position on the domain of every vertex.
//
// The mesh is stored as in source_mesh_file.h. Each vertex also carries
//   _DOMAIN_TRIANGLE    SCALAR float: the domain triangle i, a whole number below 2^24
//   _DOMAIN_ALPHA_BETA  VEC4 float: (alpha high, beta high, alpha low, beta low); high + low is exact
// and the mesh's `extras.lozenge_domain` holds the domain: {"version", "vertices", "corners": [[a, b, c], ...],
// "neighbours": [[t, s, t, s, t, s], ...]}, the neighbour of side s as (triangle, side), -1, -1 where there is none.
// Where parts have scales of their own, "version" is 2, else 1, and "first_levels": [k, ...] has one for each triangle.
// "source_triangles" is the number of the surface's triangles before edges were split for the map, where that is known.
#pragma once

#include <filesystem>
#include <utility>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// \pre `mesh` is canonical and has a triangle, and `map` has a position for each of its vertices
/// \throws Error(kUsage) where the file can't be written, Error(kLimit) where it would pass the 4 GB of a GLB or has
///         2^24 domain triangles or more
void write_parameterization(const std::filesystem::path& path, const SourceMesh& mesh, const Parameterization& map);

/// What `write_parameterization` was given, bit by bit. The domain and its first levels are sound and every position lies on it; whether
/// the map folds is not looked at.
/// \throws Error(kUnusableInput) where the file is broken or isn't one of these
std::pair<SourceMesh, Parameterization> read_parameterization(const std::filesystem::path& path);

}  // namespace lozenge
