// What a source mesh promises: welded, oriented, without degenerate triangles, attributes that fit.
#pragma once

#include "formats/surface/source_mesh.h"
#include "stages/check/check_report.h"

namespace lozenge {

CheckReport check_source_mesh(const SourceMesh& mesh);

}  // namespace lozenge
