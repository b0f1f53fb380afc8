// The map of a connected surface: the search for a domain on a proxy, and the way back, tried until one succeeds.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "formats/base/progress.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/levels/proxy.h"
#include "stages/parameterize/parameterize.h"
#include "stages/parameterize/subject.h"

namespace lozenge {

/// What edges that stay split cost (`unsplit.h`).
struct SplitCost {
  double mean_area = 0;  ///< of the source's triangles, of all parts
  /// What taking one out may cost is no more than this share of the map's distortion: of one that is hardly distorted,
  /// next to nothing is given up.
  double of_distortion = std::numeric_limits<double>::infinity();
};

/// One way to look for a domain.
struct Attempt {
  ProxySize proxy;
  FaceRange faces;
  std::int32_t small_domain = 0;  ///< as in WorkingMap
  /// Given up where the proxy's map has a larger aggregate: the proxy doesn't show the surface well enough.
  double most_distorted = std::numeric_limits<double>::infinity();
  std::function<double(const TraceRow&)> judge = {};  ///< as in DecimationOptions
  SplitCost split_cost = {};
};

/// \param cones  vertices of the source, ascending \param first  what is tried first; what comes then has finer proxies
/// and larger domains \throws Error(kInternal) where none of it succeeds
ParameterizeResult parameterize_connected(SourceMesh source, const ParameterizeOptions& options,
                                          std::vector<VertexId> cones, const Attempt& first, const Progress& progress);

}  // namespace lozenge
