// The nodes of an asset's scene: what shows which mesh, where, and what moves it.
#pragma once

#include <span>
#include <vector>

#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/bodies.h"
#include "formats/surface/rig.h"
#include "stages/export/export.h"

namespace lozenge {

/// Writes nodes into the first scene of a model.
class AssetNodeWriter {
 public:
  /// Adds the rig, which may be empty; keeps references to the others. \param translation  what takes parts that
  /// nothing moves to the scene; their nodes say so
  AssetNodeWriter(const Rig& rig, const Vec3d& translation, LodsAs lods_as, tinygltf::Model& model, GltfBuffer& buffer);

  /// Nodes that show a part in each of its places. The first one of each place names the others, in that place, as
  /// alternatives (extension MSFT_lod, with the screen coverages from which engines choose in `extras`). Or they are
  /// siblings, whose names end in _LOD0, _LOD1, ...: so Unity, Unreal and Godot take them for levels.
  ///
  /// A node of the rig carries the mesh of a single level itself; of several, a child that stands in its place does.
  /// What a skin places are nodes of the scene. Without a rig, all stands where it is at rest. Where weights of morph
  /// targets are animated at a node of the rig, they are so at the nodes that show the levels.
  /// \param first_mesh  of the finest level; those of the others follow
  /// \param coverages   [level]
  void add(const Body& body, int first_mesh, std::span<const double> coverages);

 private:
  int add_levels(int first_mesh, std::span<const double> coverages);
  void add_to_scene(int first, std::size_t levels);
  void add_below(int mover, int first, std::size_t levels);
  bool are_siblings(std::size_t levels) const { return lods_as_ == LodsAs::kNodes && levels > 1; }
  void place(int node, std::size_t levels, const Placement& placement);
  void move_weights(int mover, int first, std::size_t levels);
  void move(int node, std::size_t levels);

  bool has_rig_;
  Vec3d translation_;
  LodsAs lods_as_;
  int first_rig_node_ = 0;
  int first_skin_ = 0;
  tinygltf::Model& model_;
};

}  // namespace lozenge
