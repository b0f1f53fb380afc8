// The materials of a surface, written into a glTF model with their images unaltered: readers/gltf/materials.h gives the
// same ones back.
#pragma once

#include "formats/files/gltf_writer.h"
#include "formats/files/readers/gltf/model.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Adds a material for each of the mesh, with its textures. \pre the model has no materials yet
void add_materials(const SourceMesh& mesh, tinygltf::Model& model, GltfBuffer& buffer);

}  // namespace lozenge
