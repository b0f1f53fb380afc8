// Morph targets of a primitive as glTF has them.
#pragma once

#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/bodies.h"
#include "stages/export/engine_mesh.h"

namespace tinygltf {
struct Mesh;
struct Primitive;
}  // namespace tinygltf

namespace lozenge {

/// Adds the targets of a mesh to its primitive. What most vertices have none of is stored for the others alone (sparse
/// accessors).
void add_morph_targets(tinygltf::Model& model, GltfBuffer& buffer, const EngineMesh& mesh,
                       tinygltf::Primitive& primitive);

/// Their names (where any has one) and default weights.
void describe_morph_targets(const std::vector<MorphTarget>& targets, tinygltf::Mesh& mesh);

}  // namespace lozenge
