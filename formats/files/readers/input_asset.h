// What every reader of an input format gives: meshes of primitives, where the scene has them, and what the file says of
// itself. The importer knows an asset by this alone, and no format.
#pragma once

#include <Imath/ImathMatrix.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/files/readers/deviations.h"
#include "formats/surface/bodies.h"
#include "formats/surface/material.h"
#include "formats/surface/primitive.h"
#include "formats/surface/rig.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// A primitive of triangles before it is read.
struct InputPrimitive {
  int number = 0;  ///< in its file, for messages
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::int32_t material = -1;  ///< of InputAsset::material_names, or -1
};

struct InputMesh {
  std::string name;
  std::vector<InputPrimitive> primitives;
};

/// A mesh in one place of the scene.
struct InputInstance {
  int node = -1;  ///< of the file, for messages; -1 where the format has no nodes
  int mesh = -1;
  /// From the mesh to the scene, for row vectors: p * transform. What a skin places isn't placed by its node.
  Imath::M44d transform;
  bool is_one_of_many = false;  ///< of instances of one node (EXT_mesh_gpu_instancing): its transform isn't the node's
  /// Node of the rig that it hangs on, where it moves, or has morph targets; of those that a skin places only these.
  std::int32_t mover = -1;
  std::int32_t skin = -1;                 ///< of the rig, or -1
  std::vector<MorphTarget> targets = {};  ///< that its mesh has
};

/// An asset in a file, opened. What can be said before its triangles are read is here; `read` gives those, one
/// primitive after the other, so that a mesh of many instances isn't there many times over.
struct InputAsset {
  std::string file;        ///< its name without folders: how messages start
  std::string scene_name;  ///< or the file's stem, where the format has no scenes
  std::string origin;      ///< the file that it comes from: itself, but for Lozenge's own files, which say so
  std::string generator;   ///< the program that made it, as far as known

  std::vector<InputMesh> meshes;
  std::vector<InputInstance> instances;

  std::vector<std::string> material_names;
  std::vector<Material> material_looks;  ///< [material]; empty where the format says nothing of them
  std::vector<EncodedImage> images;      ///< that textures of those show
  std::vector<bool> double_sided;        ///< [material]; empty where none are
  /// SourceMesh::cap_of and ::bodies, of Lozenge's own files.
  std::vector<std::int32_t> cap_of;
  Bodies bodies;
  Rig rig;  ///< what moves the instances, or the bodies

  /// One of Lozenge's own files, untouched by others: what there was to repair was repaired before it was made, and
  /// edges that are open are meant to be, even where they lie along each other (a cut through a one-sided surface).
  bool is_repaired = false;

  std::uint64_t memory = 0;             ///< bytes that it takes, about
  std::int64_t ignored_primitives = 0;  ///< points, lines, and polygons of fewer than three corners
  std::vector<std::string> notes;       ///< sentences about what isn't taken, for the log
  Deviations deviations;                ///< of the file from its format

  /// The box of a primitive's positions. What a file says of it may do, or they are looked at where `exactly` is set.
  /// Null where it can't be asked. \throws Error(kUnusableInput) as `read` does
  std::function<Bounds(int mesh, int primitive, bool exactly)> extent;

  /// The primitive `meshes[mesh].primitives[primitive]`. Of a mesh that one instance places it is given once.
  /// \throws Error(kUnusableInput) naming the place
  /// Those of a mesh that a skin places carry joints and weights.
  std::function<Primitive(int mesh, int primitive)> read;
};

/// How messages call a primitive in one place of the scene: "statue.glb: node 3, mesh 0 primitive 1", or, of a format
/// that has but one mesh, the file.
std::string place_of(const InputAsset& asset, const InputInstance& instance, int primitive);

/// An asset of one mesh where it stands, of a format that knows nothing else. Primitives without triangles are left
/// out.
/// \param file  the name of the file
InputAsset asset_of_one_mesh(const std::string& file, std::vector<Primitive> primitives,
                             std::vector<std::string> material_names);

/// "1 triangle", "2 triangles".
std::string count_of(std::int64_t number, const std::string& noun);

}  // namespace lozenge
