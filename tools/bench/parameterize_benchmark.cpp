// parameterize_benchmark: times of the parts of the method, and of the whole, on meshes of three sizes. README.md tells
// how to run it, and how to compare two builds.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "stages/parameterize/parameterize.h"
#include "tools/bench/benchmark_subject.h"
#include "tools/bench/benchmarks.h"

namespace lozenge::bench {

void add_benchmark(const std::string& name, const SubjectPointer& subject,
                   const std::function<void(benchmark::State&, Subject&)>& run) {
  const std::string full_name = name + "/" + subject->size().name;
  const auto run_on_subject = [subject, run](benchmark::State& state) { run(state, *subject); };
#ifndef __clang_analyzer__  // takes what the library keeps for lost
  benchmark::RegisterBenchmark(full_name.c_str(), run_on_subject)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
#endif
}

namespace {

/// Items are triangles of the mesh. The counters tell what came out: faster and worse is another thing than faster.
void parameterize_mesh(benchmark::State& state, const SourceMesh& mesh, const ParameterizeOptions& options) {
  measure_on_copies(
      state, [&] { return mesh; },
      [&](SourceMesh& copy) {
        const ParameterizeResult result = parameterize(std::move(copy), options, {});
        state.counters["aggregate"] = result.distortion.aggregate;
        state.counters["domain"] = result.map.domain.size();
      });
  count_items(state, mesh.triangles.size());
}

void add_benchmarks(const Size& size) {
  const auto subject = std::make_shared<Subject>(size);
  add_level_benchmarks(subject);
  add_domain_benchmarks(subject);
  add_optimization_benchmarks(subject);
  add_measure_benchmarks(subject);
  add_benchmark("parameterize", subject,
                [](benchmark::State& state, Subject& s) { parameterize_mesh(state, s.mesh(), s.options()); });
  add_benchmark("parameterize_ring", subject, [](benchmark::State& state, Subject& s) {
    parameterize_mesh(state, ring(s.size().triangles), s.options());
  });
}

/// \return the program's exit code
int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return static_cast<int>(ExitCode::kUsage);
  for (const Size& size : kSizes) add_benchmarks(size);
  const std::size_t count = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  if (count == 0) throw Error(ExitCode::kUsage, "no benchmark has such a name");
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace
}  // namespace lozenge::bench

int main(int argc, char** argv) {
  try {
    return lozenge::bench::run(argc, argv);
  } catch (const lozenge::Error& error) {
    fmt::print(stderr, "parameterize_benchmark: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
