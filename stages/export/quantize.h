// Vertices in fewer bits: extension KHR_mesh_quantization.
#pragma once

#include <vector>

#include "formats/files/readers/gltf/model.h"

namespace lozenge {

/// Meshes that follow each other and stand in the same places: the levels of detail of a part.
struct MeshGroup {
  int first = 0;
  int count = 0;
};

/// Makes of positions three numbers of 16 bits in a cube around the group, of normals and tangents bytes, of texture
/// coordinates 16 bits of the atlas, of morph targets' offsets signed 16 bits; joints and weights are integers already.
/// Equal positions stay equal, and different ones different. What takes positions back are the nodes that show a group,
/// which so get a scale and a translation (a child of its own where the node is one that moves), and for skins, whose
/// nodes' transforms say nothing, the inverse bind matrices.
/// \pre each vertex attribute has a buffer view of its own in the model's one buffer, and floats in it
void quantize_vertices(tinygltf::Model& model, const std::vector<MeshGroup>& groups);

}  // namespace lozenge
