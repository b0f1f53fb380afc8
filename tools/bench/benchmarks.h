// The benchmarks of the parameterization, a function for each file of them, and what they share.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "tools/bench/benchmark_subject.h"

namespace lozenge::bench {

using SubjectPointer = std::shared_ptr<Subject>;

void add_level_benchmarks(const SubjectPointer& subject);
void add_domain_benchmarks(const SubjectPointer& subject);
void add_optimization_benchmarks(const SubjectPointer& subject);
void add_measure_benchmarks(const SubjectPointer& subject);

/// Adds the benchmark NAME/SIZE, which calls `run(state, subject)`. The clock and the processor's time of all threads
/// are measured. What `run` does before its loop isn't.
void add_benchmark(const std::string& name, const SubjectPointer& subject,
                   const std::function<void(benchmark::State&, Subject&)>& run);

/// Measures what changes its subject: `make()` makes a new one and `work(it)` changes it, and only `work` is timed; the
/// subject's end is not, either.
template <typename Make, typename Work>
void measure_on_copies(benchmark::State& state, Make make, Work work) {
  while (state.KeepRunning()) {
    state.PauseTiming();
    {
      auto subject = make();
      state.ResumeTiming();
      work(subject);
      state.PauseTiming();
    }
    state.ResumeTiming();
  }
}

/// Measures what leaves everything as it is.
template <typename Work>
void measure(benchmark::State& state, Work work) {
  while (state.KeepRunning()) benchmark::DoNotOptimize(work());
}

/// Says how many items each iteration went through.
inline void count_items(benchmark::State& state, std::size_t items) {
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(items));
}

}  // namespace lozenge::bench
