// A charted surface as the arrays that an engine uploads, one mesh for each body.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/patch_layout.h"
#include "stages/export/engine_mesh.h"
#include "stages/export/export.h"

namespace lozenge {

struct BodyMeshes {
  std::vector<EngineMesh> meshes;  ///< what stands still, then the bodies by their numbers; some may be empty
  std::int64_t cap_triangles = 0;  ///< left out with their caps
};

/// Where corner 0..2 of a triangle lies on the source.
using OriginOf = std::function<SourcePoint(std::size_t triangle, std::size_t corner)>;

/// Vertices are shared where place, texture coordinates and normal agree by bits (`framed_surface`). On borders of
/// patches and on hard edges, positions have equal bits.
/// \param origin_of  asked where the surface has origins
/// \pre triangles on caps are of `kCapGroup`
BodyMeshes body_meshes(const ChartedSurface& surface, const FramedSurface& framed, const Bodies& bodies, Caps caps,
                       const OriginOf& origin_of);

}  // namespace lozenge
