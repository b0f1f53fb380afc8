// A SourceMesh as a glTF model and back: what the mesh's own file and the parameterization's file share.
#pragma once

#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Floats at the vertices of a mesh, or of a file.
struct VertexAttribute {
  std::string name;  ///< starts with "_", as glTF demands
  int components = 1;
  std::vector<float> values;  ///< [vertex * components + component]
};

/// Fills an empty model: one scene, one node, one mesh, one primitive for each material that has triangles. Each vertex
/// of the file carries the attributes of its welded vertex, and `kSheets` where vertices share a position.
/// \param kind  what the file is, for `asset.extras.lozenge.file`
/// \pre `mesh` is canonical and has a triangle
void add_source_mesh(const SourceMesh& mesh, const std::vector<VertexAttribute>& attributes, const std::string& kind,
                     tinygltf::Model& model);

struct StoredMesh {
  SourceMesh mesh;
  std::vector<VertexId> vertex_of;          ///< [vertex of the file], all primitives one after the other
  std::vector<VertexAttribute> attributes;  ///< of the file's vertices
};

/// Whether the file says that it is of this kind.
bool is_stored_mesh(const GltfFile& file, const std::string& kind);

/// The mesh of a file of this kind, canonical, and the asked attributes' values.
/// \param attributes  names and components; what values they hold doesn't matter
/// \throws Error(kUnusableInput) where the file isn't of this kind or was changed since
StoredMesh read_stored_mesh(const GltfFile& file, const std::string& kind, std::vector<VertexAttribute> attributes);

/// The names that Lozenge keeps in its own mesh files: the scene, the file that the asset came from, and its generator.
struct StoredNames {
  std::string scene;
  std::string origin;
  std::string generator;
};

/// From a file that `add_source_mesh` made; false for any other.
bool find_stored_names(const GltfFile& file, StoredNames& names);

/// Whether the materials of any file say what they look like: not so where it is a mesh file of Lozenge of an asset
/// whose materials had but names.
bool has_material_looks(const GltfFile& file);

/// SourceMesh::double_sided from any file, for `count` materials: those of the file first.
std::vector<bool> double_sided_materials(const GltfFile& file, std::size_t count);

/// SourceMesh::cap_of from such a file; empty where it has none, or none that makes sense.
std::vector<std::int32_t> find_stored_caps(const GltfFile& file);

/// SourceMesh::bodies and ::rig from such a file; empty where it has none, or none that make sense.
struct StoredBodies {
  Bodies bodies;
  Rig rig;
};
StoredBodies find_stored_bodies(const GltfFile& file);

}  // namespace lozenge
