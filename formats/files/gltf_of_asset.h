// An asset of any format as a glTF document.
#pragma once

#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/input_asset.h"

namespace lozenge {

/// A document of the asset's first mesh, where it stands: for formats that know no more. Attributes are made fit.
GltfDocument gltf_of_asset(InputAsset asset);

}  // namespace lozenge
