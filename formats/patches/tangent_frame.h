// The tangent frames of a level of detail: the one place that says in which frame a tangent-space normal is. The baker
// writes normals in these frames, the exporter stores them with the vertices, the renderer reads normals in them.
//
// As engines do: a vertex has a unit normal, a unit tangent at a right angle to it, and the sign of the bitangent. In
// between, normal and tangent are interpolated over the triangle and each made a unit vector again, the bitangent is
// cross(normal, tangent) * sign, and the texel's (x, y, z) means the direction x tangent + y bitangent + z normal. Away
// from vertices the three are not quite at right angles; the baker inverts them as they are, so this order of steps
// gives the source's normal back.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_grids.h"

namespace lozenge {

/// Of every vertex of every patch (glTF's TANGENT.w). The tangent is the direction of growing u, which lies to the
/// right in the texture; glTF's normal maps have y pointing up in it, against growing v; and the grid runs
/// counter-clockwise on the outside of the surface. So cross(normal, tangent) is the direction of v, and y is its
/// opposite.
inline constexpr float kBitangentSign = -1;

struct FrameVertex {
  Vec3f normal{0, 0, 1};   ///< unit
  Vec3f tangent{1, 0, 0};  ///< unit, at a right angle to the normal
  Vec2f texcoord{0, 0};    ///< glTF's convention, v down

  /// glTF's TANGENT.
  Vec4f tangent_with_sign() const { return {tangent.x, tangent.y, tangent.z, kBitangentSign}; }
};

/// Every patch owns its vertices, because texture coordinates and tangents break at its borders.
struct FrameVertices {
  PatchGrids grids;                   ///< of the samples that the level draws
  std::vector<FrameVertex> vertices;  ///< [grids.index(patch, i, j)]

  const FrameVertex& at(std::int32_t patch, std::int32_t i, std::int32_t j) const {
    return vertices[grids.index(patch, i, j)];
  }
};

/// Normals are the geometry image's. A tangent is the mean of the directions of growing u in the patch's own triangles
/// around the vertex, each laid into the vertex's tangent plane and weighted by the triangle's angle there. Samples
/// that a patch doesn't have (beyond the surface's boundary) keep the defaults above. \pre  0 <= level <
/// image.levels.size(), layout is one of the image's patches
FrameVertices frame_vertices(const GeometryImage& image, int level, const MapLayout& layout);

/// The tangents of any triangles over an atlas, [vertex], as those of the grid are: means of the directions of growing
/// u in the triangles of a vertex, weighted by their angles. \param normals  unit \param texcoords  in which triangles
/// are counter-clockwise where v runs up the square
std::vector<Vec3f> vertex_tangents(const std::vector<Vec3f>& positions, const std::vector<Vec3f>& normals,
                                   const std::vector<Vec2f>& texcoords, const std::vector<std::uint32_t>& indices);

/// What a fragment's tangent-space normal is in.
struct ShadingFrame {
  Vec3d tangent{1, 0, 0};    ///< unit
  Vec3d bitangent{0, 1, 0};  ///< as it comes from the cross product
  Vec3d normal{0, 0, 1};     ///< unit

  /// The unit vector that a texel (x, y, z in -1..1, of any length but zero) means.
  Vec3d to_object(const Vec3d& texel) const;
  /// The unit texel that means the direction; the inverse of `to_object`.
  Vec3d to_texel(const Vec3d& direction) const;
};

/// The frame at a point of the triangle of three vertices, by its barycentric weights.
ShadingFrame shading_frame(const std::array<const FrameVertex*, 3>& corners, const Vec3d& weights);

}  // namespace lozenge
