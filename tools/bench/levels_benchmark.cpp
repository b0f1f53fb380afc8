// Down to the proxy and back: the levels of the mesh. Items are triangles of the whole mesh.
#include <utility>

#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/levels/simplify_in_blocks.h"
#include "tools/bench/benchmarks.h"

namespace lozenge::bench {
namespace {

void simplify_mesh(benchmark::State& state, Subject& subject) {
  const SourceMesh& mesh = subject.mesh();
  const HalfedgeMesh whole = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
  measure_on_copies(
      state, [&] { return HalfedgeMesh(whole); },
      [&](HalfedgeMesh& copy) {
        benchmark::DoNotOptimize(simplify_in_blocks(copy, mesh.positions, subject.proxy_triangles()));
      });
  count_items(state, mesh.triangles.size());
}

void refine_map(benchmark::State& state, Subject& subject) {
  const Subject::Coarse& coarse = subject.coarse();
  measure_on_copies(
      state, [&] { return coarse; },
      [](Subject::Coarse& copy) { benchmark::DoNotOptimize(refine(copy.map, std::move(copy.hierarchy), {}, {})); });
  count_items(state, subject.mesh().triangles.size());
}

}  // namespace

void add_level_benchmarks(const SubjectPointer& subject) {
  add_benchmark("simplify", subject, simplify_mesh);
  add_benchmark("refine", subject, refine_map);
}

}  // namespace lozenge::bench
