// The materials of a surface: those of its file, and one more for each that a body has, so that triangles say by their
// material what they are part of.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/files/readers/input_asset.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

class SurfaceMaterials {
 public:
  explicit SurfaceMaterials(const InputAsset& asset);

  /// The material of triangles of a body. \param material  of the file, or -1 where they have none
  std::int32_t of_body(std::int32_t body, std::int32_t material);

  /// For `SurfaceBuilder::finish`.
  const std::vector<std::string>& names() const { return names_; }

  /// Sets what a mesh with these materials, and perhaps the builder's default one, says of them.
  void describe(const InputAsset& asset, std::vector<Body> bodies, SourceMesh& mesh) const;

 private:
  std::vector<std::string> names_;
  std::size_t of_file_;
  /// [body, material of the file] the material
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> added_;
};

}  // namespace lozenge
