// Morph targets of meshes (glTF 2.0 specification, Sec. 3.7.2.2): which do anything, what they are called, and their
// offsets as attributes of vertices.
#pragma once

#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/input_asset.h"
#include "formats/surface/bodies.h"
#include "formats/surface/primitive.h"

namespace lozenge {

/// The morph targets of a mesh that move any of its vertices or turn any of its normals.
struct MeshTargets {
  std::vector<int> numbers;          ///< in the file, ascending
  std::vector<MorphTarget> targets;  ///< names from the mesh's extras, weights that the mesh has
  int in_file = 0;                   ///< how many there are, those that do nothing too

  bool empty() const { return numbers.empty(); }
};

/// [mesh] of the file; of those that no instance places, none. \param idle  whether those that do nothing are kept, too
/// \throws Error(kUnusableInput) where a target isn't what the specification allows for its primitive
std::vector<MeshTargets> find_targets(const GltfFile& file, const std::vector<InputInstance>& instances,
                                      bool idle = false);

/// Adds those targets of a primitive to the attributes of its vertices: `kMorphOffsets`, and `kMorphNormals` where both
/// it and its target have normals.
/// \pre  the primitive was read from the same place
void add_targets(const GltfFile& file, int mesh, int primitive, const MeshTargets& targets, Primitive& read);

/// The weights of those targets, of the list of weights of all that a node, a mesh or a key of an animation has.
template <typename Number>
std::vector<Number> weights_of(const MeshTargets& targets, const std::vector<Number>& all) {
  std::vector<Number> weights;
  for (const int number : targets.numbers) {
    weights.push_back(static_cast<std::size_t>(number) < all.size() ? all[static_cast<std::size_t>(number)] : 0);
  }
  return weights;
}

}  // namespace lozenge
