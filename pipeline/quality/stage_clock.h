// What a run costs: seconds and peak memory, stage by stage.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "pipeline/quality/quality_report.h"

namespace lozenge {

/// Stages follow each other: one begins where the one before it ends.
class StageClock {
 public:
  StageClock();

  /// Ends the stage that runs, if one does, and begins the next.
  void begin(const std::string& name);
  /// Ends the stage that runs.
  /// \return its cost
  StageCost end();

  /// Ends the stage that runs and enters the costs into a report.
  void finish(QualityReport& report);

  const std::vector<StageCost>& stages() const { return stages_; }
  /// Since the clock was made.
  double seconds() const;
  /// The largest of all finished stages, in megabytes.
  double peak_memory_mb() const;

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_;
  Clock::time_point stage_start_;
  std::string running_;
  std::vector<StageCost> stages_;
};

}  // namespace lozenge
