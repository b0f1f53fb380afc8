// The source's own triangles over an atlas of patches, with the normals that it has: the level of detail that has lost
// nothing.
#pragma once

#include <functional>
#include <span>

#include "formats/domain/parameterization.h"
#include "formats/patches/charted_surface.h"
#include "formats/patches/map_layout.h"
#include "formats/patches/patch_layout.h"
#include "formats/patches/source_cut.h"
#include "formats/surface/attribute_streams.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// What a place of a triangle of the source carries: between these of its corners (elements of the mesh's corner
/// attributes), whose weights add up to 1. Of a cut through an edge they are its ends, the lower vertex first, so that
/// two triangles that agree there agree between.
using CarriedBetween = std::function<Vec3f(std::span<const WeightedElement> corners)>;

/// The cut triangles as a charted surface: vertices as in the cut surface, each with one position. Groups are the
/// source's triangles where `group_of` is that, or whatever else may be told apart.
/// \param group_of  [triangle of the source]
ChartedSurface charted_surface(const SourceMesh& mesh, const CutSurface& cut, const CarriedBetween& carried,
                               const std::function<std::int32_t(TriangleId)>& group_of);

inline constexpr std::int32_t kCapGroup = 1;

/// The group of a triangle of the source that bends, and the triangle of such a group; -1 of all others.
constexpr std::int32_t group_of_bent(TriangleId t) { return -1 - t; }
constexpr TriangleId bent_triangle(std::int32_t group) { return group < 0 ? -1 - group : -1; }

/// The source cut along the borders of patches, corners carrying its unit normals (those of its vertices where it has
/// none of its own), without the vertices that it doesn't need in this atlas. Triangles on caps are of `kCapGroup`,
/// those that a skin places or morph targets bend of a group each (`group_of_bent`), others of one for each class of
/// looks (look_classes.h). Positions of different vertices differ.
/// \param patches  of the map's domain
/// \throws Error(kUnusableInput) where the map is broken
ChartedSurface source_level(const SourceMesh& mesh, const Parameterization& map, const PatchLayout& patches,
                            const MapLayout& layout);

/// [patch] a number for the connected part of the surface that it belongs to, from 0 on.
std::vector<std::int32_t> parts_of_patches(const std::vector<std::array<PatchSide, 4>>& adjacency);

}  // namespace lozenge
