#include "stages/parameterize/parameterize.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/surface/canonical_form.h"
#include "stages/parameterize/certify.h"
#include "stages/parameterize/levels/proxy.h"
#include "stages/parameterize/levels/refine.h"
#include "stages/parameterize/levels/simplify_in_blocks.h"
#include "stages/parameterize/levels/split_long_edges.h"
#include "stages/parameterize/map/curve_order.h"
#include "stages/parameterize/map/topology.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/parts.h"
#include "stages/parameterize/relax/crawl.h"
#include "stages/parameterize/relax/global_optimization.h"
#include "stages/parameterize/relax/newton.h"
#include "stages/parameterize/search/decimation.h"

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

/// The number of triangles that a domain shall have.
struct FaceRange {
  std::int32_t least = 0;
  std::int32_t most = 0;
};

/// What the topology leaves of a range: where all of it is too small, sizes that have been found to do.
FaceRange reachable(const FaceRange& faces, std::int32_t least) {
  constexpr std::int32_t kRoom = 4;
  return faces.most >= least ? faces : FaceRange{least, kRoom * least};
}

/// The surface that the map is of, and its connectivity.
struct Subject {
  SourceMesh mesh;
  HalfedgeMesh halfedges;  ///< of all of it, until a domain is looked for
  std::vector<VertexId> cones;

  void connect() { halfedges = make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size())); }
  void become(SourceMesh split, const std::vector<VertexId>& number_of) {
    mesh = std::move(split);
    for (VertexId& v : cones) v = number_of[v];
    connect();
  }
};

/// What splitting its edges may make of a mesh. Triangles about as wide as high take 2 / longest_edge^2 for each of the
/// domain's, halving makes up to 4 times as many of that, and odd ones some more; a needle, a thousand times as long
/// as a domain triangle or more, would take millions.
std::int64_t most_triangles(const SourceMesh& mesh, const FaceRange& faces, double longest_edge) {
  constexpr double kOfDomainTriangle = 16;
  constexpr double kOfTriangle = 30;
  return std::llround(kOfDomainTriangle / (longest_edge * longest_edge) * faces.most +
                      kOfTriangle * static_cast<double>(mesh.triangles.size()));
}

/// Numbers near what lies near in space, where the mesh's arrays are so long that it is far apart in memory else.
void number_along_curve(Subject& subject) {
  constexpr std::size_t kLeast = 100'000;
  if (subject.mesh.triangles.size() < kLeast) return;
  const std::vector<VertexId> number = make_canonical(subject.mesh, triangles_along_curve(subject.mesh));
  for (VertexId& cone : subject.cones) cone = number[cone];
}

/// Splits what is too long beside the domain's triangles, and what would hold a domain's boundary on itself.
void make_fine_enough(Subject& subject, const FaceRange& faces, double longest_edge) {
  std::vector<VertexId> number_of;
  const SourceMesh& mesh = subject.mesh;
  const double area = surface_area(mesh.positions, mesh.triangles);
  const double longest = longest_edge * std::sqrt(area / (faces.most * 0.5 * kHalfRoot3));
  if (longest > 0 && has_longer_edge(mesh, longest)) {
    SourceMesh split = split_long_edges(mesh, longest, most_triangles(mesh, faces, longest_edge), &number_of);
    subject.become(std::move(split), number_of);
  }
  if (has_chord(subject.halfedges)) subject.become(split_chords(mesh, &number_of), number_of);
}

/// Vertices of a level that Newton's method on all of them is still quick on; before the way back, and after it.
constexpr std::size_t kMostForNewtonOnProxy = 10'000;
constexpr std::size_t kMostForNewton = 20'000;

/// Newton's method and crawling cones in turn, until these stay.
void settle(WorkingMap& map) {
  constexpr int kTurns = 3;
  newton_all(map, {});
  for (int turn = 0; turn < kTurns && crawl_all(map, 2) > 0; ++turn) newton_all(map, {});
}

/// One way to look for a domain.
struct Attempt {
  ProxySize proxy;
  FaceRange faces;
  std::int32_t small_domain = 0;  ///< as in WorkingMap
  /// Given up where the proxy's map has a larger aggregate: the proxy doesn't show the surface well enough.
  double most_distorted = std::numeric_limits<double>::infinity();
  std::function<double(const TraceRow&)> judge = {};  ///< as in DecimationOptions
};

/// The domain from a proxy, brought back to the whole surface.
void parameterize_by_proxy(ParameterizeResult& result, Subject& subject, const ParameterizeOptions& options,
                           const Attempt& attempt, const Progress& progress) {
  const auto& [proxy_size, range, small_domain, most_distorted, judge] = attempt;
  const SourceMesh& mesh = subject.mesh;
  const std::vector<VertexId>& cones = subject.cones;
  report(progress, "simplifying", 0);
  const double flattest = flattest_to_keep(mesh.positions, mesh.triangles);
  HalfedgeMesh simplified = std::move(subject.halfedges);
  Hierarchy hierarchy;
  if (proxy_size.triangles_per_face > 0) {
    const double size = std::min(proxy_size.triangles_for(range.most), 2e9);
    hierarchy = simplify_in_blocks(simplified, mesh.positions, static_cast<std::int32_t>(size), cones);
  }

  const Proxy proxy = extract_proxy(simplified, mesh.positions);
  WorkingMap coarse = trivial_map(proxy.positions, proxy.mesh, flattest);
  keep_cones(coarse, proxy, cones);
  coarse.energy = {options.energy, options.gamma};
  coarse.star_conformality = options.star_conformality;
  coarse.small_domain = small_domain;
  DecimationOptions decimation;
  decimation.min_faces = range.least;
  decimation.max_faces = range.most;
  decimation.at_once = !options.partitions_in_turn;
  decimation.mesh_size = {proxy_size.triangles_per_face, 0.8 * proxy_size.least};
  decimation.judge = judge;
  std::vector<Removal> coarser;
  result.trace = decimate(coarse, decimation, coarser, part_of(progress, 0.1, 0.5));

  GlobalOptions global;
  global.at_once = !options.partitions_in_turn;
  free_regular_vertices(coarse);
  optimize_globally(coarse, global);
  if (coarse.home.size() <= kMostForNewtonOnProxy) settle(coarse);
  if (measure_map(coarse).aggregate > most_distorted) {
    throw Error(ExitCode::kInternal, "the map of the proxy is too distorted");
  }
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
  result.map = certified(map, subject.mesh, result.distortion);
  result.surface = std::move(subject.mesh);
}

/// A connected surface.
ParameterizeResult parameterize_part(SourceMesh source, const ParameterizeOptions& options, std::vector<VertexId> cones,
                                     const Attempt& first, const Progress& progress) {
  ParameterizeResult result;
  Subject subject{std::move(source), {}, std::move(cones)};
  number_along_curve(subject);
  subject.connect();
  result.least_domain_faces = least_domain_faces(topology_of(subject.halfedges));
  const FaceRange faces = reachable(first.faces, result.least_domain_faces);
  // A few triangles, or needles, may leave no map to smaller domains; there always is the one to themselves.
  constexpr std::size_t kMostForItself = 10'000;
  std::optional<SourceMesh> whole;
  if (subject.mesh.triangles.size() <= kMostForItself) whole = subject.mesh;
  make_fine_enough(subject, faces, options.longest_edge / std::sqrt(enough_triangles(faces.most)));
  // Where the way back from a coarse proxy is blocked, a finer one leaves more room, and so does a larger domain; the
  // surface itself needs no way back.
  const ProxySize finer{first.proxy.triangles_per_face * 2.5, first.proxy.least * 2.5};
  const FaceRange larger{faces.most, 2 * faces.most};
  const FaceRange largest{faces.most, 4 * faces.most};
  constexpr double kMostDistorted = 0.6;
  std::vector<Attempt> attempts{
      {first.proxy, faces, first.small_domain, kMostDistorted}, {finer, faces}, {finer, larger}, {finer, largest}};
  if (first.proxy.triangles_per_face == 0) {
    attempts.front().most_distorted = Attempt{}.most_distorted;
    attempts.erase(attempts.begin() + 1);
  }
  constexpr std::size_t kMostForNoProxy = 200'000;
  if (subject.mesh.triangles.size() <= kMostForNoProxy) attempts.push_back({{0, 0}, largest});
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    attempts[i].judge = first.judge;
    try {
      parameterize_by_proxy(result, subject, options, attempts[i], progress);
      return result;
    } catch (const Error& e) {
      if (e.code() != ExitCode::kInternal || (i + 1 == attempts.size() && !whole)) throw;
    }
    subject.connect();
  }
  result.map = map_to_itself(*whole);
  result.surface = std::move(*whole);
  result.distortion = measure_distortion(result.surface, result.map);
  return result;
}

/// The user's cones that lie on a part, by its own numbers.
std::vector<VertexId> cones_of(const Part& part, const std::vector<VertexId>& cones) {
  std::vector<VertexId> found;
  for (std::size_t v = 0; !cones.empty() && v < part.vertices.size(); ++v) {
    if (std::binary_search(cones.begin(), cones.end(), part.vertices[v])) found.push_back(static_cast<VertexId>(v));
  }
  return found;
}

/// The energies of the parts' last epochs, each weighed by its area.
std::vector<double> weighed_sum(const std::vector<ParameterizeResult>& made, const std::vector<Part>& parts) {
  double area = 0;
  std::size_t epochs = 1;
  for (std::size_t p = 0; p < made.size(); ++p) {
    area += parts[p].area;
    epochs = std::max(epochs, made[p].energies.size());
  }
  std::vector<double> sum(epochs, 0);
  for (std::size_t p = 0; p < made.size(); ++p) {
    const std::vector<double>& energies = made[p].energies;
    for (std::size_t e = 0; e < epochs; ++e) {
      const double energy = energies.empty() ? 1 : energies[std::min(e, energies.size() - 1)];
      sum[e] += energy * (area > 0 ? parts[p].area / area : 0);
    }
  }
  return sum;
}

/// The part of a share that gives its triangles about the size that others have. \param faces  at that size
Allotment narrowed(const Allotment& share, double faces) {
  constexpr double kEitherWay = 0.05;
  const auto within = [&](double n) {
    return static_cast<std::int32_t>(
        std::clamp(n, static_cast<double>(share.min_faces), static_cast<double>(share.max_faces)));
  };
  // Closed surfaces have even numbers of triangles only: two at least in each interval.
  const std::int32_t least = within(std::floor(faces * (1 - kEitherWay)));
  return {least, within(std::max(std::ceil(faces * (1 + kEitherWay)), least + 1.0)), share.is_itself};
}

/// Each part on its own: the largest one first, whose size sets the scale, then as many at once as there are
/// threads.
ParameterizeResult parameterize_parts(std::vector<Part> parts, const ParameterizeOptions& options,
                                      const std::vector<VertexId>& cones, const Progress& progress) {
  constexpr double kLeastProxy = 400;
  std::vector<Allotment> shares = allot(parts, options.min_domain_faces, options.max_domain_faces);
  std::vector<ParameterizeResult> made(parts.size());
  std::vector<std::exception_ptr> failures(parts.size());
  std::mutex reporting;
  std::size_t done = 0;
  const auto largest =
      std::max_element(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.area < b.area; });
  const auto first = static_cast<std::size_t>(largest - parts.begin());
  const auto make = [&](std::size_t p) {
    try {
      if (shares[p].is_itself) {
        made[p].map = map_to_itself(parts[p].mesh);
        made[p].surface = std::move(parts[p].mesh);
        made[p].least_domain_faces = shares[p].min_faces;
      } else {
        Attempt attempt{{options.proxy_triangles_per_face, kLeastProxy}, {shares[p].min_faces, shares[p].max_faces}};
        // The size that is best for all parts, not for itself.
        if (p == first && largest->area > 0) {
          attempt.judge = [&](const TraceRow& row) { return weighed_whole(parts, shares, first, row); };
        }
        made[p] = parameterize_part(std::move(parts[p].mesh), options, cones_of(parts[p], cones), attempt, {});
      }
    } catch (...) {
      failures[p] = std::current_exception();
    }
    const std::scoped_lock lock(reporting);
    report(progress, "parameterizing the parts", static_cast<double>(++done) / static_cast<double>(parts.size()));
  };
  make(first);
  if (!failures[first] && largest->area > 0) {
    const double density = made[first].map.domain.size() / largest->area;
    for (std::size_t p = 0; p < parts.size(); ++p) shares[p] = narrowed(shares[p], density * parts[p].area);
  }
  for_each_index(parts.size(), true, [&](std::size_t p) {
    if (p != first) make(p);
  });
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  ParameterizeResult result;
  for (const ParameterizeResult& part : made) result.least_domain_faces += part.least_domain_faces;
  for (const Allotment& share : shares) result.parts_as_they_are += share.is_itself;
  result.trace = std::move(made[first].trace);
  result.energies = weighed_sum(made, parts);
  std::vector<MappedPart> mapped;
  mapped.reserve(made.size());
  for (ParameterizeResult& part : made) mapped.push_back({std::move(part.surface), std::move(part.map)});
  MappedPart whole = join_parts(std::move(mapped));
  result.surface = std::move(whole.surface);
  result.map = std::move(whole.map);
  result.distortion = measure_distortion(result.surface, result.map);
  return result;
}

}  // namespace

ParameterizeResult parameterize(SourceMesh source, const ParameterizeOptions& options, const Progress& progress) {
  require_sense(options);
  std::vector<VertexId> cones = checked_cones(source, options);
  if (!is_connected(source)) return parameterize_parts(split_into_parts(source), options, cones, progress);
  constexpr double kLeastProxy = 2000;
  const Attempt attempt{{options.proxy_triangles_per_face, kLeastProxy},
                        {options.min_domain_faces, options.max_domain_faces},
                        WorkingMap{}.small_domain};
  return parameterize_part(std::move(source), options, std::move(cones), attempt, progress);
}

std::string note_on_domain_size(const ParameterizeResult& made, const ParameterizeOptions& options) {
  const std::int32_t faces = made.map.domain.size();
  if (faces <= options.max_domain_faces) return {};
  const std::string asked = std::to_string(options.min_domain_faces) + ".." + std::to_string(options.max_domain_faces);
  const std::string least = std::to_string(made.least_domain_faces) + " at least";
  const std::string why = made.least_domain_faces <= options.max_domain_faces
                              ? "no smaller domain was found that leaves the map without folds"
                          : made.parts_as_they_are > 0
                              ? std::to_string(made.parts_as_they_are) +
                                    " of its parts are so small that they keep their own triangles, which makes " +
                                    least
                              : "its handles, holes and parts need " + least;
  return "the domain has " + std::to_string(faces) + " triangles, not " + asked + ": " + why + "; --domain-faces " +
         std::to_string(faces) + ".." + std::to_string(2 * faces) + " leaves more room";
}

}  // namespace lozenge
