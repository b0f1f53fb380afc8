#include "tools/bench/benchmark_subject.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "formats/base/error.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/levels/proxy.h"
#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/levels/simplify_in_blocks.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/search/decimation.h"
#include "tools/bench/bench_mesh.h"

namespace lozenge::bench {

namespace {

SourceMesh source_mesh(Surface surface, const char* name) {
  SourceMesh mesh;
  mesh.positions = std::move(surface.positions);
  mesh.triangles = std::move(surface.triangles);
  mesh.origin = name;
  return mesh;
}

/// The subject is as smooth as can be, so no step fails on it.
void require(bool success) {
  if (!success) throw Error(ExitCode::kInternal, "the benchmark's surface lost its map");
}

}  // namespace

SourceMesh relief_sphere(std::int32_t triangles) {
  constexpr double kHeight = 0.25;
  Surface surface = sphere_mesh(triangles);
  for (Vec3f& position : surface.positions) {
    const Vec3d p(position);
    const double waves = (std::sin(4 * p.x + 1) + std::sin(5 * p.y + 2) + std::sin(6 * p.z + 3)) / 3;
    position = Vec3f(p * (1 + kHeight * waves));
  }
  return source_mesh(std::move(surface), "relief sphere");
}

SourceMesh ring(std::int32_t triangles) { return source_mesh(torus_mesh(triangles), "ring"); }

ParameterizeOptions Subject::options() const {
  ParameterizeOptions options;
  options.min_domain_faces = size_.min_domain_faces;
  options.max_domain_faces = size_.max_domain_faces;
  return options;
}

std::int32_t Subject::proxy_triangles() const {
  return static_cast<std::int32_t>(ProxySize{options().proxy_triangles_per_face}.triangles_for(size_.max_domain_faces));
}

const SourceMesh& Subject::mesh() {
  if (!mesh_) mesh_ = relief_sphere(size_.triangles);
  return *mesh_;
}

const Subject::Coarse& Subject::coarse() {
  if (coarse_) return *coarse_;
  const std::vector<Vec3f>& positions = mesh().positions;
  HalfedgeMesh simplified = make_halfedge_mesh(mesh().triangles, static_cast<std::int32_t>(positions.size()));
  Hierarchy hierarchy = simplify_in_blocks(simplified, positions, proxy_triangles());
  const Proxy proxy = extract_proxy(simplified, positions);
  WorkingMap map = trivial_map(proxy.positions, proxy.mesh);
  DecimationOptions decimation;
  decimation.min_faces = size_.min_domain_faces;
  decimation.max_faces = size_.max_domain_faces;
  std::vector<Removal> coarser;
  decimate(map, decimation, coarser, {});
  free_regular_vertices(map);
  optimize_globally(map, {});
  require(refine(map, std::move(coarser), {}, {}));
  coarse_ = Coarse{map_of_simplified(map, proxy, std::move(simplified), positions), std::move(hierarchy)};
  return *coarse_;
}

const WorkingMap& Subject::refined() {
  if (refined_) return *refined_;
  WorkingMap map = coarse().map;
  require(refine(map, coarse().hierarchy, {}, {}));
  refined_ = std::move(map);
  return *refined_;
}

const WorkingMap& Subject::optimized() {
  if (optimized_) return *optimized_;
  WorkingMap map = refined();
  GlobalOptions global;
  global.cones = Cones::kAlongEdges;
  global.tolerance = 2e-3;  // as in `parameterize`
  global.most_epochs = 40;
  optimize_globally(map, global);
  optimized_ = std::move(map);
  return *optimized_;
}

const Subject::Certified& Subject::certified() {
  if (certified_) return *certified_;
  WorkingMap map = optimized();
  Certified made;
  made.surface = mesh();
  map.positions = &made.surface.positions;
  std::optional<ProvedMap> proved = lozenge::certified(map, made.surface);
  require(proved.has_value());
  made.map = std::move(proved->map);
  certified_ = std::move(made);
  return *certified_;
}

}  // namespace lozenge::bench
