// Which placements of a mesh become surface, and which only say where the surface of another one is to be seen again.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/files/readers/input_asset.h"
#include "formats/surface/repeats.h"

namespace lozenge {

struct RepeatedMeshes {
  std::vector<RepeatedMesh> meshes;
  std::vector<std::int32_t> surface_of;  ///< [instance] the one of `meshes` that it is the surface of, or -1
  std::vector<bool> is_copy;             ///< [instance] whether it is one of the copies, and no surface
};

/// Of each mesh, the first placement that may be shared is surface, and the others that may be are copies of it. One
/// that is sheared against the first, which no node of a glTF can say by itself, is surface of its own.
/// \param may_be_shared  [instance]; not where it touches something else, for it may be joined with that
RepeatedMeshes find_repeated_meshes(const InputAsset& asset, const std::vector<bool>& may_be_shared);

}  // namespace lozenge
