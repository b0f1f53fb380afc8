// What an operation on one side or another of the domain would raise the energy by: found out on trial, remembered
// until something near changes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/relax/trials.h"

namespace lozenge {

/// What one operation (all collapses, say) would raise the energy by, for each edge of one domain.
class KnownRises {
 public:
  /// Tries those of the sides that aren't remembered. \param fresh  whether `copies` were made since the map changed
  void find_out(const WorkingMap& map, const SurfaceMeasures& measures, const std::vector<DomainSide>& sides,
                const Operation& operation, TrialCopies& copies, bool& fresh);

  /// Nothing where the operation can't be carried out. \pre found out
  std::optional<double> of(const Domain& domain, DomainSide side) const;

  /// The stars of `n` and of its neighbours are no longer what they were.
  void forget_near(const WorkingMap& map, DomainVertex n);

  void forget_all() { edges_.clear(); }

 private:
  struct Edge {
    std::array<DomainVertex, 4> corners{-1, -1, -1, -1};  ///< of the diamond around it when it was tried
    std::optional<double> rise;
  };
  std::vector<Edge> edges_;  ///< [edge number]
};

}  // namespace lozenge
