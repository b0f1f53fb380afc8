// A rig as the nodes, skins and animations of a glTF model, and back.
#pragma once

#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/rig.h"

namespace lozenge {

/// Appends all of it; nodes and skins stay in their order. Nodes without one above them go into the first scene.
/// \return the first node's number in the model
int add_rig(const Rig& rig, tinygltf::Model& model, GltfBuffer& buffer);

}  // namespace lozenge
