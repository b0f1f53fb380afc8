// An epoch relaxes all vertices, or the three partitions in turn as in the paper, and then moves the cones. That needs
// lists of the vertices at home only where stars are laid out; where cones crawl along edges, the epochs run on a copy
// of the map whose neighbours are near in memory.
#include "stages/parameterize/relax/global_optimization.h"

#include <algorithm>

#include "stages/parameterize/map/compact_map.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/parameterize/map/pins.h"
#include "stages/parameterize/map/star.h"
#include "stages/parameterize/relax/cones.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/local_optimization.h"
#include "stages/parameterize/relax/sweeps.h"
#include "stages/parameterize/relax/trials.h"

namespace lozenge {

namespace {

/// The part that holds the image of `v`; a pinned one's is its domain vertex's half-star, whatever was rounded.
std::int32_t part_of(const WorkingMap& map, VertexId v, Partition partition) {
  if (partition == Partition::kHalfStars && map.pin[v] >= 0) return map.pin[v];
  return part_of(map.domain, map.home[v], barycentrics(map.at[v]), partition);
}

std::vector<DomainVertex> irregular_vertices(const WorkingMap& map) {
  std::vector<DomainVertex> found;
  for (DomainVertex n = 0; n < static_cast<DomainVertex>(map.corner_of.size()); ++n) {
    if (map.corner_of[n].triangle >= 0 && !valence(map, n).is_regular()) found.push_back(n);
  }
  return found;
}

/// Moves cones that gain by it. Most don't: which ones do is found out on copies, on all threads.
void optimize_cones(WorkingMap& map) {
  const std::vector<DomainVertex> cones = irregular_vertices(map);
  std::vector<char> gains(cones.size(), 0);
  TrialCopies copies;
  copies.run(map, {}, cones.size(), false, [&](TrialCopy& copy, std::size_t i) {
    const auto move = [&](LocalChange& change) { return optimize_cone(change, cones[i], kRelaxStar); };
    gains[i] = on_trial(copy.map, copy.scratch, move).has_value();
  });
  Scratch scratch;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    if (gains[i]) optimize_cone(map, cones[i], kRelaxStar, scratch);
  }
}

}  // namespace

std::vector<VertexId> vertices_inside(const WorkingMap& map, Partition partition) {
  std::vector<VertexId> inside;
  for (const VertexId v : vertices_by_triangle(map)) {
    if (map.pin[v] >= 0) continue;
    const std::int32_t part = part_of(map, v, partition);
    bool whole = true;
    for_each_neighbour(map.mesh, v, [&](VertexId w) { whole = whole && part_of(map, w, partition) == part; });
    if (whole) inside.push_back(v);
  }
  return inside;
}

void free_regular_vertices(WorkingMap& map) {
  for (DomainVertex n = 0; n < static_cast<DomainVertex>(map.corner_of.size()); ++n) {
    if (map.corner_of[n].triangle >= 0 && map.anchor[n] >= 0 && valence(map, n).is_regular())
      free_regular_vertex(map, map.anchor[n]);
  }
}

namespace {

/// Of each cone: after so many it is time to relax what they have left behind.
constexpr int kStepsInEpoch = 2;

std::vector<double> optimize_in_epochs(WorkingMap& map, const GlobalOptions& options) {
  std::vector<double> energies{total_energy(map)};
  constexpr double kToTheEnd = 1e-3;  // sweeps that gain less than that are for the next epoch, if there is one
  const RelaxOptions sweeps{options.sweeps, kToTheEnd};
  for (int epoch = 0; epoch < options.most_epochs; ++epoch) {
    if (options.at_once) {
      relax_all(map, sweeps);
    } else {
      for (const Partition p : {Partition::kFaces, Partition::kHalfDiamonds, Partition::kHalfStars}) {
        relax(map, vertices_inside(map, p), sweeps);
      }
    }
    if (options.cones == Cones::kInTheirStars) optimize_cones(map);
    if (options.cones == Cones::kAlongEdges) crawl_all(map, kStepsInEpoch);
    energies.push_back(total_energy(map));
    const double before = energies[energies.size() - 2];
    if (before - energies.back() < options.tolerance * (before - 1)) break;
  }
  return energies;
}

}  // namespace

std::vector<double> optimize_globally(WorkingMap& map, const GlobalOptions& options) {
  const bool needs_lists = !options.at_once || options.cones == Cones::kInTheirStars;
  if (needs_lists && !map.listed) list_homes(map);
  if (needs_lists) return optimize_in_epochs(map, options);
  return on_compact_copy(map, [&](WorkingMap& near) { return optimize_in_epochs(near, options); });
}

}  // namespace lozenge
