// One level of detail as the vertex and index arrays that an engine uploads.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/domain/source_locator.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"

namespace lozenge {

/// What a morph target does to each vertex, at a weight of 1. Empty arrays change nothing.
struct MorphDeltas {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec3f> tangents;
};

/// Arrays of one primitive, [vertex]. Vertices on the border of two patches exist once for each, with positions of
/// equal bits.
struct EngineMesh {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;          ///< unit
  std::vector<Vec4f> tangents;         ///< unit, at a right angle to the normal; w is the sign of the bitangent
  std::vector<Vec2f> texcoords;        ///< glTF's convention, v down
  std::vector<float> influences;       ///< elements of `kInfluences`; empty where no body has a skin
  std::vector<SourcePoint> origins;    ///< where they lie on the source; empty where no body has morph targets
  std::vector<std::uint32_t> indices;  ///< three for each triangle, counter-clockwise seen from outside
  std::vector<MorphDeltas> targets;    ///< of its body

  std::int64_t triangle_count() const { return static_cast<std::int64_t>(indices.size() / 3); }
};

/// Sides of a level's triangles that lie on the surface's boundary.
std::int64_t count_boundary_sides(const GeometryImage& image, int level);

/// The mesh of a level, every patch in its row order. Where the level is coarser than `frame_level`, for which the
/// normal map was baked, its vertices keep the normals and tangents that they have there: the map fits best in the
/// frames that it was made for.
EngineMesh engine_mesh(const GeometryImage& image, int level, const MapLayout& layout, int frame_level);

/// Takes out the triangles of the patches that aren't kept. \param keep  [patch] \pre as for `leave_out_caps`
void keep_patches(EngineMesh& mesh, const GeometryImage& image, int level, const std::vector<bool>& keep);

/// Appends another mesh's vertices and triangles.
void append(EngineMesh& mesh, const EngineMesh& more);

/// Takes out the triangles that have two or three corners on a cap. \return how many
/// \pre  `mesh` is that of this level of `image`, as `engine_mesh` made it
std::int64_t leave_out_caps(EngineMesh& mesh, const GeometryImage& image, int level);

/// The mesh of a level in bodies: what stands still, then the others by their numbers. Some may be empty.
/// \pre  as for `leave_out_caps`
std::vector<EngineMesh> split_bodies(EngineMesh mesh, const GeometryImage& image, int level);

/// Some triangles and the vertices that they use. \param triangles  by their numbers, in the order that they are to
/// have
EngineMesh chosen_triangles(const EngineMesh& mesh, const std::vector<std::size_t>& triangles);

/// Reorders triangles and vertices for the GPU: its cache of transformed vertices, then overdraw, then memory reads in
/// order (meshoptimizer). Vertices that no triangle uses go.
void order_for_gpu(EngineMesh& mesh);

}  // namespace lozenge
