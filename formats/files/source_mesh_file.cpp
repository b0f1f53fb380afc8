#include "formats/files/source_mesh_file.h"

#include <tiny_gltf.h>

#include "formats/base/error.h"
#include "formats/files/gltf_source_mesh.h"
#include "formats/files/gltf_writer.h"

namespace lozenge {

namespace {

constexpr const char* kKind = "source mesh";

}  // namespace

void write_source_mesh(const std::filesystem::path& path, const SourceMesh& mesh) {
  tinygltf::Model model;
  add_source_mesh(mesh, {}, kKind, model);
  write_glb(path, model);
}

SourceMesh read_source_mesh(const std::filesystem::path& path) {
  const GltfFile file = open_gltf(path);
  return read_stored_mesh(file, kKind, {}).mesh;
}

bool is_source_mesh_file(const std::filesystem::path& path) {
  try {
    return is_stored_mesh(open_gltf(path), kKind);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace lozenge
