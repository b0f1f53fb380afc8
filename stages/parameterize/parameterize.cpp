// A connected surface is parameterized as it is (`connected_surface.h`); of several parts each on its own, with its
// share of the domain, and the maps are put together (`parts.h`).
#include "stages/parameterize/parameterize.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "stages/parameterize/connected_surface.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/parts.h"

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
  constexpr double kEitherWay = 0.05;  // room for the search, and an area of triangles that nobody tells apart
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
  constexpr double kLeastProxy = 400;  // triangles: there may be hundreds of parts, each of a few domain triangles
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
        made[p] = parameterize_connected(std::move(parts[p].mesh), options, cones_of(parts[p], cones), attempt, {});
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
  constexpr double kLeastProxy = 2000;  // triangles: fewer don't show the surface's shape
  const Attempt attempt{{options.proxy_triangles_per_face, kLeastProxy},
                        {options.min_domain_faces, options.max_domain_faces},
                        WorkingMap{}.small_domain};
  return parameterize_connected(std::move(source), options, std::move(cones), attempt, progress);
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
