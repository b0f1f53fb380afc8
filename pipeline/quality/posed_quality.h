// How an asset's levels hold up where its own animations take them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/base/progress.h"
#include "formats/files/asset_file.h"
#include "formats/surface/pose.h"
#include "pipeline/quality/quality_report.h"
#include "stages/render/render.h"

namespace lozenge {

/// Compares each level with the source, at rest and in some poses of the source's animations.
/// \param name  how messages call the asset
PosedFacts measure_in_poses(const SourceMesh& source, const Asset& asset, const std::string& name,
                            const Progress& progress);

/// The finest level in two poses, each with a caption; none where nothing is animated.
std::vector<std::pair<std::string, Picture>> pictures_in_poses(const Asset& asset, const std::string& name,
                                                               const RenderOptions& options);

}  // namespace lozenge
