// A surface of one part or several: each is parameterized on its own, with its share of the domain and a scale of its
// own, and the maps are put together.
//
// In the paper a surface is one; nothing in it couples two that don't touch but the distance between samples.
#pragma once

#include <vector>

#include "formats/base/progress.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/parameterize.h"

namespace lozenge {

/// \param cones  vertices of the source, ascending
/// \throws Error(kInternal) where a part's map was not found
ParameterizeResult parameterize_part_by_part(SourceMesh source, const ParameterizeOptions& options,
                                             const std::vector<VertexId>& cones, const Progress& progress);

}  // namespace lozenge
