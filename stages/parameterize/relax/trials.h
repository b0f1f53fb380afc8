// Trying operations out on copies of a map, on all threads.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "formats/base/parallel.h"
#include "stages/parameterize/map/checkpoint.h"
#include "stages/parameterize/map/path_lengths.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// Copies of a map, on which things are tried that are not to show in it. Of several, each is tried on the same copy on
/// any number of threads: what one leaves behind when it is taken back (the order of lists) is there for the next.
class TrialCopies {
 public:
  struct Copy {
    WorkingMap map;
    SurfaceMeasures measures;
  };

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
  std::array<Copy, 4> copies_;
};

/// Carries an operation on a side out, with the way back in `undo`, and says in `rise` what it raises the energy by.
/// \return false, with nothing changed, where it can't be carried out
using Attempt = std::function<bool(TrialCopies::Copy& copy, DomainSide side, Checkpoint& undo, double& rise)>;

/// What the operation raises the energy by, tried out and taken back; nothing where it can't be carried out.
inline std::optional<double> rise_on_trial(TrialCopies::Copy& copy, DomainSide side, const Attempt& attempt) {
  Checkpoint undo(copy.map);
  double rise = 0;
  if (!attempt(copy, side, undo, rise)) return std::nullopt;
  undo.restore();
  return rise;
}

}  // namespace lozenge
