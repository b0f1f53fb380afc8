// Global optimization of the map (paper, Sec. 5.5 and 5.6).
#pragma once

#include <vector>

#include "formats/domain/partition.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// The vertices that may move while a partition is optimized: those whose whole ring has its image inside of one part.
/// Vertices of triangles that lie across two parts stay.
std::vector<VertexId> vertices_inside(const WorkingMap& map, Partition partition);

/// How irregular vertices move between the sweeps: not at all, each in its star (5.6), or along mesh edges (`crawl`).
enum class Cones { kStay, kInTheirStars, kAlongEdges };

struct GlobalOptions {
  int most_epochs = 10;
  /// Ends when an epoch lowers the energy by less than this share of its distance from 1.
  double tolerance = 1e-3;
  int sweeps = 6;  ///< of each partition in an epoch
  /// Optimize all vertices at once instead of one partition after the other. All interpolation domains but the
  /// irregular stars are rigid, so the energy is the same, and no vertex has to wait for its turn.
  bool at_once = true;
  Cones cones = Cones::kInTheirStars;
};

/// Epochs until convergence. The energy never rises. \return the energy after each epoch, the first entry before all
std::vector<double> optimize_globally(WorkingMap& map, const GlobalOptions& options);

/// Lets go of the source vertices that are pinned to regular domain vertices.
void free_regular_vertices(WorkingMap& map);

}  // namespace lozenge
