// Where coordinates are large (surveys in projected coordinates have millions of metres), floats are too coarse for the
// surface. Then positions are kept around an origin of their own.
#pragma once

#include <Imath/ImathMatrix.h>

#include <vector>

#include "formats/base/vector.h"
#include "formats/files/readers/input_asset.h"

namespace lozenge {

/// Where the surface's positions are to be counted from, in the scene: the scene's origin, unless the surface lies so
/// far from it, measured by its own size, that floats lose what they have there. Of an asset that a node moves there,
/// it is where that node puts its mesh's origin, so that positions stay those of the mesh. \param standing  [node of
/// the rig], \param joints  [skin of the rig][joint] where they stand in the scene
Vec3d local_origin(const InputAsset& asset, const std::vector<Imath::M44d>& standing,
                   const std::vector<std::vector<Imath::M44d>>& joints);

}  // namespace lozenge
