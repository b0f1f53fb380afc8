#include "stages/parameterize/parameterize.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "formats/error.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/crawl.h"
#include "stages/parameterize/decimation.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/levels.h"
#include "stages/parameterize/newton.h"
#include "stages/parameterize/proxy.h"
#include "stages/parameterize/split_long_edges.h"
#include "stages/parameterize/working_map.h"

namespace lozenge {

namespace {

void require_sense(const ParameterizeOptions& o) {
  if (o.min_domain_faces < 4 || o.max_domain_faces < o.min_domain_faces) {
    throw Error(ExitCode::kUsage, "the domain's range " + std::to_string(o.min_domain_faces) + ".." +
                                      std::to_string(o.max_domain_faces) + " is empty or starts below 4");
  }
  if (!(o.gamma >= 0)) throw Error(ExitCode::kUsage, "gamma must not be negative");
  if (!(o.star_conformality >= 0 && o.star_conformality <= 1)) {
    throw Error(ExitCode::kUsage, "the conformality of stars lies between 0 and 1");
  }
}

/// The cones that the user wants, each once. \throws Error(kUsage) where the mesh has no such vertex
std::vector<VertexId> checked_cones(const SourceMesh& mesh, const ParameterizeOptions& options) {
  std::vector<VertexId> cones = options.cones;
  std::sort(cones.begin(), cones.end());
  cones.erase(std::unique(cones.begin(), cones.end()), cones.end());
  const auto count = static_cast<VertexId>(mesh.positions.size());
  if (!cones.empty() && (cones.front() < 0 || cones.back() >= count)) {
    const VertexId wrong = cones.front() < 0 ? cones.front() : cones.back();
    throw Error(ExitCode::kUsage, "there is no vertex " + std::to_string(wrong) + " to be a cone: " + mesh.origin +
                                      " has vertices 0 to " + std::to_string(count - 1));
  }
  return cones;
}

/// Marks the domain vertices of the trivial map that the user wants to stay.
void keep_cones(WorkingMap& map, const Proxy& proxy, const std::vector<VertexId>& cones) {
  for (const VertexId cone : cones) {
    const auto at = std::lower_bound(proxy.vertices.begin(), proxy.vertices.end(), cone);
    map.kept[map.pin[at - proxy.vertices.begin()]] = 1;
  }
}

/// A share of the whole progress, as a progress of its own.
Progress part_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [&progress, from, to](std::string_view what, double done) {
    progress(what, from + (to - from) * std::clamp(done, 0.0, 1.0));
  };
}

/// Splits what is too long beside the domain's triangles.
SourceMesh without_long_edges(SourceMesh mesh, const ParameterizeOptions& options, std::vector<VertexId>& cones) {
  if (options.longest_edge <= 0) return mesh;
  const double area = surface_area(mesh.positions, mesh.triangles);
  const double side = std::sqrt(area / (options.max_domain_faces * 0.5 * kHalfRoot3));
  const double longest = options.longest_edge * side;
  if (!(longest > 0) || !has_longer_edge(mesh, longest)) return mesh;
  constexpr std::int64_t kMostTriangles = 20'000'000;
  std::vector<VertexId> number_of;
  SourceMesh split = split_long_edges(mesh, longest, kMostTriangles, &number_of);
  for (VertexId& v : cones) v = number_of[v];
  return split;
}

/// The surface with triangles that leave the map its freedom.
SourceMesh fine_enough(SourceMesh mesh, const ParameterizeOptions& options, std::vector<VertexId>& cones) {
  mesh = without_long_edges(std::move(mesh), options, cones);
  std::vector<VertexId> number_of;
  std::optional<SourceMesh> split = split_chords(mesh, &number_of);
  if (!split) return mesh;
  for (VertexId& v : cones) v = number_of[v];
  return std::move(*split);
}

/// Vertices of a level that Newton's method on all of them is still quick on.
constexpr std::size_t kMostForNewton = 20'000;

/// Newton's method and crawling cones in turn.
void settle(WorkingMap& map) {
  constexpr int kTurns = 3;
  for (int turn = 0; turn < kTurns; ++turn) {
    newton_all(map, {});
    crawl_all(map, 2);
  }
  newton_all(map, {});
}

/// The domain from a proxy of so many triangles for each of the domain's, brought back to the whole surface.
void parameterize_by_proxy(ParameterizeResult& result, const ParameterizeOptions& options,
                           const std::vector<VertexId>& cones, double triangles_per_face, const Progress& progress) {
  const SourceMesh& mesh = result.surface;
  report(progress, "simplifying", 0);
  HalfedgeMesh simplified = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
  Hierarchy hierarchy;
  if (triangles_per_face > 0) {
    constexpr double kLeast = 2000;
    const double size = std::max(kLeast, triangles_per_face * options.max_domain_faces);
    hierarchy = simplify_in_blocks(simplified, mesh.positions, static_cast<std::int32_t>(std::min(size, 2e9)), cones);
  }

  const Proxy proxy = extract_proxy(simplified, mesh.positions);
  WorkingMap coarse = trivial_map(proxy.positions, proxy.mesh);
  keep_cones(coarse, proxy, cones);
  coarse.energy = {options.energy, options.gamma};
  coarse.star_conformality = options.star_conformality;
  DecimationOptions decimation;
  decimation.min_faces = options.min_domain_faces;
  decimation.max_faces = options.max_domain_faces;
  decimation.at_once = !options.partitions_in_turn;
  decimation.triangles_per_face = triangles_per_face;
  std::vector<Removal> coarser;
  result.trace = decimate(coarse, decimation, coarser, part_of(progress, 0.1, 0.5));

  GlobalOptions global;
  global.at_once = !options.partitions_in_turn;
  free_regular_vertices(coarse);
  optimize_globally(coarse, global);
  settle(coarse);
  refine(coarse, std::move(coarser), {}, {});
  WorkingMap map = map_of_simplified(coarse, proxy, std::move(simplified), mesh.positions);
  refine(map, std::move(hierarchy), {}, part_of(progress, 0.5, 0.7));
  report(progress, "optimizing the map", 0.7);
  if (mesh.positions.size() <= kMostForNewton) settle(map);
  global.cones = Cones::kAlongEdges;
  global.tolerance = 2e-3;
  global.most_epochs = 40;
  result.energies = optimize_globally(map, global);
  report(progress, "proving the map", 0.95);
  result.map = certified(map, result.surface, result.distortion);
}

}  // namespace

ParameterizeResult parameterize(SourceMesh source, const ParameterizeOptions& options, const Progress& progress) {
  require_sense(options);
  ParameterizeResult result;
  std::vector<VertexId> cones = checked_cones(source, options);
  result.surface = fine_enough(std::move(source), options, cones);
  // Where the way back from a coarse proxy is blocked, a finer one leaves more room; the surface itself needs no way
  // back.
  double triangles_per_face = options.proxy_triangles_per_face;
  for (int attempt = 0; attempt < 3; ++attempt, triangles_per_face *= 2.5) {
    try {
      parameterize_by_proxy(result, options, cones, triangles_per_face, progress);
      return result;
    } catch (const Error& e) {
      if (e.code() != ExitCode::kInternal || triangles_per_face == 0) throw;
    }
  }
  parameterize_by_proxy(result, options, cones, 0, progress);
  return result;
}

}  // namespace lozenge
