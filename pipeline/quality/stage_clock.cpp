#include "pipeline/quality/stage_clock.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace lozenge {
namespace {

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Makes the kernel forget the peak of resident memory ("5", see proc(5)); without effect where it can't.
void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Peak of resident memory since it was last forgotten, in megabytes (10^6 bytes).
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) != 0) continue;
    double kib = 0;
    std::istringstream(line.substr(6)) >> kib;
    return kib * 1024 / 1e6;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace

StageClock::StageClock() : start_(Clock::now()), stage_start_(start_) {}

void StageClock::begin(const std::string& name) {
  if (!running_.empty()) end();
  running_ = name;
  forget_peak_memory();
  stage_start_ = Clock::now();
}

StageCost StageClock::end() {
  stages_.push_back({running_, seconds_between(stage_start_, Clock::now()), peak_memory()});
  running_.clear();
  return stages_.back();
}

void StageClock::finish(QualityReport& report) {
  if (!running_.empty()) end();
  report.stages = stages_;
  report.seconds = seconds();
  report.peak_memory_mb = peak_memory_mb();
}

double StageClock::seconds() const { return seconds_between(start_, Clock::now()); }

double StageClock::peak_memory_mb() const {
  double peak = 0;
  for (const StageCost& stage : stages_) peak = std::max(peak, stage.peak_memory_mb);
  return peak;
}

}  // namespace lozenge
