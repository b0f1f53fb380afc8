// Work on all rows of all patches, in parallel, with progress.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "formats/base/progress.h"

namespace lozenge {

/// Calls `work(row)` for 0 <= row < rows from several threads. Between batches, which are large enough to keep the
/// threads busy, progress is told.
template <typename Work>
void for_each_row(std::int64_t rows, const Progress& progress, std::string_view what, const Work& work) {
  constexpr std::int64_t kBatches = 20;
  for (std::int64_t batch = 0; batch < kBatches; ++batch) {
    report(progress, what, static_cast<double>(batch) / kBatches);
    tbb::parallel_for(rows * batch / kBatches, rows * (batch + 1) / kBatches, work);
  }
  report(progress, what, 1);
}

}  // namespace lozenge
