// A proxy of the surface is made, and on it a domain is searched for (paper, Sec. 5.1); the map is brought back to the
// whole surface level by level, optimized there (5.5, 5.6), and rounded to the file's lattice, where it is proved. Each
// of these steps may fail on an odd surface without anything being wrong with the program: then the next attempt starts
// over with a finer proxy, with a larger domain, in the end without a proxy, or the surface becomes its own domain.
// What is wrong with the program is thrown, and stops all of this.
#include "stages/parameterize/connected_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "formats/base/error.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/levels/simplify_in_blocks.h"
#include "stages/parameterize/levels/unsplit.h"
#include "stages/parameterize/map/topology.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/own_domain.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/newton.h"
#include "stages/parameterize/search/decimation.h"
#include "stages/parameterize/search/measure_map.h"

namespace lozenge {

namespace {

/// What the topology leaves of a range: where all of it is too small, sizes that have been found to do.
FaceRange reachable(const FaceRange& faces, std::int32_t least) {
  constexpr std::int32_t kRoom = 4;  // what the topology needs leaves the shape none: up to so many times that
  return faces.most >= least ? faces : FaceRange{least, kRoom * least};
}

/// Marks the domain vertices of the trivial map that the user wants to stay.
void keep_cones(WorkingMap& map, const Proxy& proxy, const std::vector<VertexId>& cones) {
  for (const VertexId cone : cones) {
    const auto at = std::lower_bound(proxy.vertices.begin(), proxy.vertices.end(), cone);
    map.kept[map.pin[at - proxy.vertices.begin()]] = 1;
  }
}

/// A share of the whole progress, as a progress of its own.
Progress share_of(const Progress& progress, double from, double to) {
  if (!progress) return {};
  return [&progress, from, to](std::string_view what, double done) {
    progress(what, from + (to - from) * std::clamp(done, 0.0, 1.0));
  };
}

/// Vertices of a level that Newton's method on all of them is still quick on; before the way back, and after it.
constexpr std::size_t kMostForNewtonOnProxy = 10'000;
constexpr std::size_t kMostForNewton = 20'000;

/// Newton's method and crawling cones in turn, until these stay.
void settle(WorkingMap& map) {
  constexpr int kTurns = 3;  // a bound on the time: it ends where no cone moves any more
  constexpr int kSteps = 2;  // of each cone in a turn: what it leaves behind has to relax
  newton_all(map, {});
  for (int turn = 0; turn < kTurns && crawl_all(map, kSteps) > 0; ++turn) newton_all(map, {});
}

MapSettings settings_of(const ParameterizeOptions& options, const Attempt& attempt, const SourceMesh& mesh) {
  return {flattest_to_keep(mesh.positions, mesh.triangles),
          {options.energy, options.gamma},
          options.star_conformality,
          attempt.small_domain};
}

/// The options of what the domain is searched for by, on a proxy.
DecimationOptions search_options(const ParameterizeOptions& options, const Attempt& attempt) {
  // The mesh may get a little coarser yet while the domain shrinks.
  constexpr double kOfLeastProxy = 0.8;
  DecimationOptions decimation;
  decimation.min_faces = attempt.faces.least;
  decimation.max_faces = attempt.faces.most;
  decimation.at_once = !options.partitions_in_turn;
  decimation.mesh_size = {attempt.proxy.triangles_per_face, kOfLeastProxy * attempt.proxy.least};
  decimation.judge = attempt.judge;
  return decimation;
}

/// The last optimization, on the surface itself: there each epoch costs most, and cones are near their places.
GlobalOptions last_effort(const ParameterizeOptions& options) {
  return {.most_epochs = 40, .tolerance = 2e-3, .at_once = !options.partitions_in_turn, .cones = Cones::kAlongEdges};
}

/// What an attempt has led to.
struct Tried {
  std::optional<ParameterizeResult> made;
  bool is_stuck = false;  ///< the domain stayed far larger than was asked for, and than is worth going on with
};

/// Of this domain nobody wants a map: it is far from what was asked for, and the surface by itself isn't much larger.
bool is_stuck(std::int32_t faces, const Attempt& attempt, std::int32_t worthwhile) {
  constexpr std::int32_t kFar = 4;
  return faces > kFar * attempt.faces.most && faces > worthwhile;
}

/// The domain from a proxy, brought back to the whole surface. Nothing is made where the search is stuck, the proxy's
/// map is too distorted, the way back is blocked, or no proof was found; the subject's mesh is then what it was,
/// without its connectivity. \param worthwhile  domain triangles
Tried parameterize_by_proxy(Subject& subject, const ParameterizeOptions& options, const Attempt& attempt,
                            std::int32_t worthwhile, const Progress& progress) {
  ParameterizeResult result;
  const SourceMesh& mesh = subject.mesh;
  report(progress, "simplifying", 0);
  const MapSettings settings = settings_of(options, attempt, mesh);
  HalfedgeMesh simplified = std::move(subject.halfedges);
  Hierarchy hierarchy;
  if (attempt.proxy.triangles_per_face > 0) {
    const double size = std::min(attempt.proxy.triangles_for(attempt.faces.most), 2e9);
    hierarchy = simplify_in_blocks(simplified, mesh.positions, static_cast<std::int32_t>(size), subject.cones);
  }

  const Proxy proxy = extract_proxy(simplified, mesh.positions);
  WorkingMap coarse = trivial_map(proxy.positions, proxy.mesh, settings);
  keep_cones(coarse, proxy, subject.cones);
  std::vector<Removal> coarser;
  result.trace = decimate(coarse, search_options(options, attempt), coarser, share_of(progress, 0.1, 0.5));
  if (is_stuck(coarse.domain_faces, attempt, worthwhile)) return {{}, true};

  free_regular_vertices(coarse);
  GlobalOptions on_proxy;
  on_proxy.at_once = !options.partitions_in_turn;
  optimize_globally(coarse, on_proxy);
  if (coarse.home.size() <= kMostForNewtonOnProxy) settle(coarse);
  if (measure_map(coarse).aggregate > attempt.most_distorted) return {};
  if (!refine(coarse, std::move(coarser), {}, {})) return {};
  WorkingMap map = map_of_simplified(coarse, proxy, std::move(simplified), mesh.positions);
  if (!refine(map, std::move(hierarchy), {}, share_of(progress, 0.5, 0.7))) return {};
  report(progress, "optimizing the map", 0.7);
  if (mesh.positions.size() <= kMostForNewton) settle(map);
  result.energies = optimize_globally(map, last_effort(options));
  report(progress, "proving the map", 0.95);
  std::optional<ProvedMap> proved = certified(map, subject.mesh);
  if (!proved) return {};
  result.map = std::move(proved->map);
  result.distortion = proved->distortion;
  result.surface = std::move(subject.mesh);
  return {std::move(result)};
}

/// [vertex] whether it lies at one of these positions.
std::vector<char> lies_at(const SourceMesh& mesh, std::vector<Vec3f> positions) {
  const auto before = [](const Vec3f& a, const Vec3f& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::sort(positions.begin(), positions.end(), before);
  std::vector<char> found(mesh.positions.size());
  for (std::size_t v = 0; v < found.size(); ++v) {
    found[v] = std::binary_search(positions.begin(), positions.end(), mesh.positions[v], before);
  }
  return found;
}

/// What a vertex less may cost of the distortion, times the area.
double worth_of_a_vertex(const ParameterizeResult& result, const SplitCost& cost) {
  // As many triangles as the source has, and the pieces that those are cut into, are worth so much of the distortion.
  constexpr double kWorth = 0.3;
  const double distortion = kAreaWeight * result.distortion.area + result.distortion.angle;
  return std::min(kWorth, cost.of_distortion * distortion) * cost.mean_area;
}

/// A finished map to be optimized once more. \param cones  positions of the user's
WorkingMap reopened(const ParameterizeResult& result, const MapSettings& settings, const std::vector<Vec3f>& cones) {
  WorkingMap map = working_map(result.surface, result.map);
  map.settings() = settings;
  measure_rest_shapes(map);
  if (!cones.empty()) {
    const std::vector<char> is_cone = lies_at(result.surface, cones);
    for (std::size_t v = 0; v < is_cone.size(); ++v) {
      if (is_cone[v] && map.pin[v] >= 0) map.kept[map.pin[v]] = 1;
    }
  }
  free_regular_vertices(map);
  return map;
}

/// Takes out what was split where the map can do without, and lets the others find new places.
/// \param source  positions of what was split \param cones  those of the user's
void make_whole(ParameterizeResult& result, const std::vector<Vec3f>& source, const std::vector<Vec3f>& cones,
                const Attempt& attempt, const ParameterizeOptions& options) {
  constexpr int kRounds = 2;      // what has moved lets others go; a third round takes out one in fifty
  constexpr double kMany = 0.05;  // of all vertices: fewer are not worth optimizing the map once more
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t vertices = result.surface.positions.size();
    if (static_cast<double>(vertices - std::min(vertices, source.size())) < kMany * static_cast<double>(vertices))
      break;
    ParameterizeResult whole;
    whole.surface = result.surface;
    whole.map = result.map;
    std::vector<char> may_go = lies_at(whole.surface, source);
    for (char& v : may_go) v = v == 0;
    if (take_out_splits(whole.surface, whole.map, may_go, worth_of_a_vertex(result, attempt.split_cost)) == 0) break;
    make_canonical_with_map(whole.surface, whole.map);
    WorkingMap map = reopened(whole, settings_of(options, attempt, whole.surface), cones);
    if (whole.surface.positions.size() <= kMostForNewton) settle(map);
    optimize_globally(map, last_effort(options));
    std::optional<ProvedMap> proved = certified(map, whole.surface);
    if (!proved) break;
    result.surface = std::move(whole.surface);
    result.map = std::move(proved->map);
    result.distortion = proved->distortion;
  }
  forget_numbers(result.surface);
}

/// What to try, one after the other. Where the way back from a coarse proxy is blocked, a finer one leaves more room,
/// and so does a larger domain; the surface itself needs no way back.
std::vector<Attempt> attempts_after(const Attempt& first, const FaceRange& faces, std::size_t triangles) {
  constexpr double kFiner = 2.5;                    // each attempt costs about so many times the one before
  constexpr std::size_t kMostForNoProxy = 200'000;  // beyond, a search on all of it takes too long
  constexpr double kMostDistorted = 0.6;            // aggregate; surfaces that a proxy shows well stay far below
  const ProxySize finer{first.proxy.triangles_per_face * kFiner, first.proxy.least * kFiner};
  const FaceRange larger{faces.most, 2 * faces.most};
  const FaceRange largest{faces.most, 4 * faces.most};
  std::vector<Attempt> attempts{{first.proxy, faces, first.small_domain, kMostDistorted}};
  if (first.proxy.triangles_per_face == 0) attempts.front().most_distorted = Attempt{}.most_distorted;
  else attempts.push_back({finer, faces});
  attempts.push_back({finer, larger});
  attempts.push_back({finer, largest});
  if (triangles <= kMostForNoProxy) attempts.push_back({{0, 0}, largest});
  for (Attempt& attempt : attempts) attempt.judge = first.judge;
  return attempts;
}

/// The surface as its own domain.
ParameterizeResult parameterize_by_itself(SourceMesh surface) {
  ParameterizeResult result;
  result.map = map_to_itself(surface);
  result.surface = std::move(surface);
  result.distortion = measure_distortion(result.surface, result.map);
  return result;
}

}  // namespace

ParameterizeResult parameterize_connected(SourceMesh source, const ParameterizeOptions& options,
                                          std::vector<VertexId> cones, const Attempt& first, const Progress& progress) {
  std::vector<Vec3f> places_of_cones;
  for (const VertexId cone : cones) places_of_cones.push_back(source.positions[cone]);
  Subject subject{std::move(source), {}, std::move(cones), {}};
  number_along_curve(subject);
  subject.connect();
  const std::int32_t least = least_domain_faces(topology_of(subject.halfedges));
  const FaceRange faces = reachable(first.faces, least);
  // A few triangles, or needles, may leave no map to smaller domains; there always is the one to themselves. Nobody
  // wants a domain of more.
  constexpr std::size_t kMostForItself = 10'000;
  std::optional<SourceMesh> whole;
  if (subject.mesh.triangles.size() <= kMostForItself) whole = subject.mesh;
  make_fine_enough(subject, faces, options.longest_edge / std::sqrt(enough_triangles(faces.most)));
  // A surface that can be its own domain needs no other one of half as many triangles: where the search is stuck above
  // that, as it is on needles, finer proxies and larger domains only take longer.
  const std::int32_t worthwhile =
      whole ? static_cast<std::int32_t>(whole->triangles.size() / 2) : std::numeric_limits<std::int32_t>::max();
  std::optional<ParameterizeResult> result;
  for (const Attempt& attempt : attempts_after(first, faces, subject.mesh.triangles.size())) {
    Tried tried = parameterize_by_proxy(subject, options, attempt, worthwhile, progress);
    result = std::move(tried.made);
    if (result || tried.is_stuck) break;
    subject.connect();
  }
  if (result && !subject.unsplit.empty()) make_whole(*result, subject.unsplit, places_of_cones, first, options);
  if (!result && whole) result = parameterize_by_itself(std::move(*whole));
  if (!result) {
    throw Error(ExitCode::kInternal, "no map of " + subject.mesh.origin +
                                         " without folds was found, with finer proxies and larger domains neither; "
                                         "please report this with the file");
  }
  result->least_domain_faces = least;
  return std::move(*result);
}

}  // namespace lozenge
