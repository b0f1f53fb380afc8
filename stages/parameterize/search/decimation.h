// The general algorithm (paper, Sec. 5.1): from the trivial map to a domain of few triangles, by collapses, with flips
// and global optimization in between; and the best number of triangles in an interval (Sec. 5.8).
#pragma once

#include <functional>
#include <vector>

#include "formats/base/progress.h"
#include "stages/parameterize/levels/proxy.h"
#include "stages/parameterize/levels/removal.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/search/trace.h"

namespace lozenge {

struct DecimationOptions {
  /// From so many times the interval's largest domain on, so many of the cheapest collapses are tried each time.
  double judged_below = 1.5;
  int tried_collapses = 16;
  std::int32_t min_faces = 100;
  std::int32_t max_faces = 200;
  /// A rough global optimization each time the domain has shrunk by this factor.
  double optimize_every = 4;
  bool at_once = true;  ///< as in GlobalOptions
  /// From so many times the interval's largest domain on, the global optimization moves cones, too.
  double cones_below = 2.25;
  /// The mesh is coarsened along with the domain, down to where its own coarseness would show in the trace.
  ProxySize mesh_size{40, 1600};
  /// What is to be least over the interval; empty: `TraceRow::weighed` (paper, eq. 6).
  std::function<double(const TraceRow&)> judge;
};

/// Decimates `map` (the trivial one) through the interval and goes back to the size in it that is judged best. Where
/// the interval can't be reached, because every collapse would change the topology or fold the map, the domain stays
/// larger. \return the trace over the interval, from the most faces to the fewest
/// Vertices that it takes out of the mesh on the way are appended to `removals`.
std::vector<TraceRow> decimate(WorkingMap& map, const DecimationOptions& options, std::vector<Removal>& removals,
                               const Progress& progress);

}  // namespace lozenge
