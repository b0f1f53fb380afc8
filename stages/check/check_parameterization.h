// What a parameterization promises: a sound domain, positions on the lattice, images that tile it without a fold.
#pragma once

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/check/check_report.h"

namespace lozenge {

CheckReport check_parameterization(const SourceMesh& mesh, const Parameterization& map);

}  // namespace lozenge
