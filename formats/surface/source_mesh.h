// The surface M of one asset: welded triangles, per-corner attributes, and what the asset said about itself.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/base/vector.h"
#include "formats/surface/attribute.h"
#include "formats/surface/bodies.h"
#include "formats/surface/material.h"
#include "formats/surface/rig.h"

namespace lozenge {

/// Triangles of one asset, joined into one surface by welding equal positions. Vertices share a position only where
/// repair parted what lay on each other: sheets along an edge of too many triangles, fans that met in a point.
///
/// Canonical form, which the importer makes and the file keeps: triangles are sorted by material (stable), vertices are
/// numbered in the order in which the corners first use them, -0 is written as +0. Importing the file of a
/// canonical mesh gives the same mesh back, bit by bit: the file says which vertices at one position are which.
struct SourceMesh {
  /// [vertex], in the asset's units, where they stand in the scene: node transforms applied, skins in their rest pose,
  /// counted from `translation`.
  std::vector<Vec3f> positions;
  /// What takes positions to the scene: not 0 where floats would be too coarse for coordinates there. Places of bodies
  /// are counted from it, too; what the rig says isn't.
  Vec3d translation{0, 0, 0};
  /// [triangle], counter-clockwise seen from outside.
  std::vector<std::array<VertexId, 3>> triangles;

  /// [3 * triangle + corner]; a stream for each attribute that the asset has, in the order of the table of their kinds.
  /// Where only some primitives carry an attribute, the others' corners hold its neutral value.
  AttributeStreams corner_attributes;

  /// [triangle] index into `material_names`; empty where the asset has no materials.
  std::vector<std::int32_t> materials;
  std::vector<std::string> material_names;
  /// [material] what it looks like; empty where the asset says nothing of that.
  std::vector<Material> material_looks;
  std::vector<EncodedImage> images;  ///< that textures of those show
  /// [material] the one whose holes its triangles cap, or -1 where it is the asset's own; empty where there are no
  /// caps.
  std::vector<std::int32_t> cap_of;
  /// [material] whether its triangles are to be seen from behind, too (glTF's doubleSided); empty where none are.
  std::vector<bool> double_sided;
  /// [material] Triangles of a body other than the one that stands still have materials of their own, and share no
  /// vertex with others.
  Bodies bodies;
  Rig rig;  ///< what moves the bodies; empty where nothing does

  std::string scene_name;  ///< name of the glTF scene, or of its only mesh or node, or the file's stem
  std::string origin;      ///< name of the file that it came from, without its folder
  std::string generator;   ///< `asset.generator` of that file
};

double triangle_area(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& triangle);
/// Of all triangles but those with corners -1.
double surface_area(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles);
/// Whether a triangle isn't the asset's own, but closes a hole in it.
inline bool is_cap(const SourceMesh& mesh, TriangleId t) {
  return !mesh.cap_of.empty() && mesh.cap_of[mesh.materials[t]] >= 0;
}

/// Whether any triangle is to be seen from both sides.
bool is_double_sided(const SourceMesh& mesh);

/// Smallest and largest coordinates; the diagonal between them is the length that distances are given in percent of.
struct Bounds {
  Vec3f low{0, 0, 0};
  Vec3f high{0, 0, 0};
};

Bounds bounds_of(const std::vector<Vec3f>& positions);
double diagonal(const Bounds& bounds);

/// Unit normals at the vertices, [vertex], the triangles around weighted by their area; (0, 0, 0) where all of them
/// have none.
std::vector<Vec3f> vertex_normals(const SourceMesh& mesh);

/// The normal that a renderer would see anywhere on the surface: the asset's own corner normals where it has them, else
/// `vertex_normals`, interpolated.
class ShadingNormals {
 public:
  /// Keeps a reference to `mesh`.
  explicit ShadingNormals(const SourceMesh& mesh);

  /// Unit normal at the point of triangle `t` with these barycentric weights; the triangle's own normal (or +z, where
  /// it has no area) where the interpolated one vanishes.
  Vec3f at(TriangleId t, const Vec3d& weights) const;

 private:
  const SourceMesh& mesh_;
  const AttributeStream* corners_;  ///< null where the asset has no normals
  std::vector<Vec3f> smooth_;       ///< [vertex], where it has none
};

}  // namespace lozenge
