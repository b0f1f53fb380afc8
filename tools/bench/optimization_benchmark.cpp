// One sweep, and one epoch of the global optimization, both from the refined map. Items are triangles of the mesh.
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/sweeps.h"
#include "tools/bench/benchmarks.h"

namespace lozenge::bench {
namespace {

void sweep(benchmark::State& state, Subject& subject) {
  const WorkingMap& map = subject.refined();
  measure_on_copies(
      state, [&] { return map; },
      [](WorkingMap& copy) {
        benchmark::DoNotOptimize(relax_all(copy, {1, 0}));
      });
  count_items(state, subject.mesh().triangles.size());
}

/// As at the end of `parameterize`: up to six sweeps, fewer where they gain little, and the cones crawl.
void epoch(benchmark::State& state, Subject& subject) {
  const WorkingMap& map = subject.refined();
  GlobalOptions options;
  options.most_epochs = 1;
  options.cones = Cones::kAlongEdges;
  measure_on_copies(
      state, [&] { return map; },
      [&](WorkingMap& copy) { benchmark::DoNotOptimize(optimize_globally(copy, options)); });
  count_items(state, subject.mesh().triangles.size());
}

}  // namespace

void add_optimization_benchmarks(const SubjectPointer& subject) {
  add_benchmark("sweep", subject, sweep);
  add_benchmark("epoch", subject, epoch);
}

}  // namespace lozenge::bench
