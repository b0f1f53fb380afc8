// What is done with a map that is good: it is measured, rounded, proved and sampled. Items are triangles of the mesh;
// of sampling, samples.
#include "formats/domain/distortion.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/map_energy.h"
#include "stages/sample/sample.h"
#include "tools/bench/benchmarks.h"

namespace lozenge::bench {
namespace {

void sum_energy(benchmark::State& state, Subject& subject) {
  const WorkingMap& map = subject.optimized();
  measure(state, [&] { return total_energy(map); });
  count_items(state, subject.mesh().triangles.size());
}

void finish(benchmark::State& state, Subject& subject) {
  const WorkingMap& map = subject.optimized();
  measure(state, [&] { return finished(map); });
  count_items(state, subject.mesh().triangles.size());
}

void certify(benchmark::State& state, Subject& subject) {
  struct Input {
    WorkingMap map;
    SourceMesh mesh;
  };
  const Input input{subject.optimized(), subject.mesh()};
  measure_on_copies(
      state, [&] { return Input(input); },
      [](Input& copy) {
        copy.map.positions = &copy.mesh.positions;
        benchmark::DoNotOptimize(certified(copy.map, copy.mesh));
      });
  count_items(state, subject.mesh().triangles.size());
}

void measure_map_distortion(benchmark::State& state, Subject& subject) {
  const Subject::Certified& made = subject.certified();
  measure(state, [&] { return measure_distortion(made.surface, made.map); });
  count_items(state, made.surface.triangles.size());
}

void sample_patches_of_17(benchmark::State& state, Subject& subject) {
  constexpr std::int32_t kSamples = 17;
  const Subject::Certified& made = subject.certified();
  std::size_t samples = 0;
  measure(state, [&] {
    PatchSet set = sample(made.surface, made.map, {kSamples});
    samples = set.positions.size();
    return set;
  });
  count_items(state, samples);
}

}  // namespace

void add_measure_benchmarks(const SubjectPointer& subject) {
  add_benchmark("total_energy", subject, sum_energy);
  add_benchmark("finished", subject, finish);
  add_benchmark("certified", subject, certify);
  add_benchmark("measure_distortion", subject, measure_map_distortion);
  add_benchmark("sample", subject, sample_patches_of_17);
}

}  // namespace lozenge::bench
