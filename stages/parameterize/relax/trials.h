// Trying operations out on copies of a map, on all threads.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/local_change.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// A copy of a map to try something on.
struct TrialCopy {
  WorkingMap map;
  SurfaceMeasures measures;
  Scratch scratch;
};

/// Copies of a map, on which things are tried that are not to show in it. Of several, each is tried on the same copy on
/// any number of threads: what one leaves behind when it is taken back (the order of lists) is there for the next.
class TrialCopies {
 public:
  /// Runs `attempt(copy, i)` for every i below `count`. The copies are made anew before, unless `again` says that
  /// neither map nor measures changed since the last time.
  template <typename Attempt>
  void run(const WorkingMap& map, const SurfaceMeasures& measures, std::size_t count, bool again, Attempt&& attempt) {
    for_each_index(copies_.size(), true, [&](std::size_t c) {
      if (!again) {
        // Into the memory that they have.
        copies_[c].map = map;
        copies_[c].measures = measures;
      }
      for (std::size_t i = c; i < count; i += copies_.size()) attempt(copies_[c], i);
    });
  }

 private:
  std::array<TrialCopy, 4> copies_;
};

/// An operation on a side. \return what it raises the energy by; nothing, with nothing changed, where it can't be
/// carried out
using Operation = std::function<std::optional<double>(LocalChange& change, SurfaceMeasures& measures, DomainSide side)>;

/// What the operation raises the energy by, tried out and taken back; nothing where it can't be carried out.
inline std::optional<double> rise_on_trial(TrialCopy& copy, DomainSide side, const Operation& operation) {
  return on_trial(copy.map, copy.scratch, [&](LocalChange& change) { return operation(change, copy.measures, side); });
}

}  // namespace lozenge
