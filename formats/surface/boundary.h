// Where a surface ends: sides of triangles that have no neighbour, and the loops that they make.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "formats/surface/surface_view.h"

namespace lozenge {

/// From one vertex to the next, with the surface on the left.
using BoundarySide = std::array<VertexId, 2>;

/// The sides of triangles whose edge no other triangle has, ascending. Vertices at positions of equal bits are one,
/// named by the lowest: so an asset ends where it does for the eye, not where its patches meet.
std::vector<BoundarySide> boundary_sides(const SurfaceView& surface);

/// The same by the vertices' numbers alone: parts that touch or coincide end each on its own.
std::vector<BoundarySide> boundary_sides(std::span<const std::array<VertexId, 3>> triangles);

/// Whether two triangles have the same side, in the same direction: a surface is no oriented manifold where they do.
bool has_repeated_sides(std::span<const std::array<VertexId, 3>> triangles);

/// [vertex] the lowest one at a position of equal bits.
std::vector<VertexId> welded_vertices(std::span<const Vec3f> positions);

/// The triangles with other vertices in the place of theirs. \param vertex  [vertex] which
std::vector<std::array<VertexId, 3>> renumbered(std::vector<std::array<VertexId, 3>> triangles,
                                                std::span<const VertexId> vertex);

/// [loop] its vertices in their order, from its lowest one; loops ascend by that. Where the sides don't chain (a
/// surface that isn't oriented, or pinched), each side is still in exactly one of them.
std::vector<std::vector<VertexId>> boundary_loops(const std::vector<BoundarySide>& sides);

}  // namespace lozenge
