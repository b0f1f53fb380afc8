// What is known of each part comes first: area, topology, a domain that it brings along. The leader of the others sets
// the density, then all are made, as many at once as there are threads, and last each gets the scale that fits what its
// domain has become.
#include "stages/parameterize/part_by_part.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "formats/base/parallel.h"
#include "formats/domain/distortion.h"
#include "stages/parameterize/allotment.h"
#include "stages/parameterize/connected_surface.h"
#include "stages/parameterize/map/topology.h"
#include "stages/parameterize/map/working_map.h"
#include "stages/parameterize/own_domain.h"
#include "stages/parameterize/parts.h"

namespace lozenge {

namespace {

/// The user's cones that lie on a part, by its own numbers.
std::vector<VertexId> cones_of(const Part& part, const std::vector<VertexId>& cones) {
  std::vector<VertexId> found;
  for (std::size_t v = 0; !cones.empty() && v < part.vertices.size(); ++v) {
    if (std::binary_search(cones.begin(), cones.end(), part.vertices[v])) found.push_back(static_cast<VertexId>(v));
  }
  return found;
}

/// The energies of the parts' last epochs, each weighed by its area.
std::vector<double> weighed_sum(const std::vector<ParameterizeResult>& made, const std::vector<PartFacts>& parts) {
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

/// All of a surface as one part.
Part whole(SourceMesh mesh) {
  Part part;
  part.area = surface_area(mesh.positions, mesh.triangles);
  part.vertices.resize(mesh.positions.size());
  std::iota(part.vertices.begin(), part.vertices.end(), 0);
  part.mesh = std::move(mesh);
  return part;
}

/// What it has once, whatever its triangles.
SourceMesh without_surface(SourceMesh mesh) {
  mesh.positions = {};
  mesh.triangles = {};
  mesh.materials = {};
  mesh.corner_attributes = {};
  return mesh;
}

/// Parts of up to so many triangles may have them as their domain: one of four, say, would be cut into as many pieces.
constexpr std::size_t kSmall = 64;
/// Of up to so many they do: any other would be cut into more.
constexpr std::size_t kTiny = 16;

/// Three times the distortion of areas, and that of angles: what the energy weighs.
double weighed(const Distortion& distortion) { return kAreaWeight * distortion.area + distortion.angle; }

class PartByPart {
 public:
  PartByPart(SourceMesh source, const ParameterizeOptions& options, const std::vector<VertexId>& cones,
             const Progress& progress)
      : options_(options), progress_(progress), triangles_(static_cast<std::int64_t>(source.triangles.size())) {
    if (is_connected(source)) {
      parts_.push_back(whole(std::move(source)));
    } else {
      parts_ = split_into_parts(source);
      names_ = without_surface(std::move(source));
    }
    for (const Part& part : parts_) {
      cones_.push_back(cones_of(part, cones));
      mean_area_ += part.area / static_cast<double>(triangles_);
    }
    made_.resize(parts_.size());
    failures_.resize(parts_.size());
    brought_along_.resize(parts_.size(), 0);
  }

  ParameterizeResult run() {
    find_facts();
    const std::optional<FaceRange> asked = asked_for();
    const Allotments allotments(facts_, asked);
    const std::int32_t leader = allotments.leader();
    if (leader >= 0) {
      Attempt attempt = attempt_at(allotments.faces_of_leader());
      if (parts_.size() == 1) attempt = attempt_at(*asked);
      // The size that is best for all parts, not for itself.
      else if (facts_[leader].area > 0) {
        attempt.judge = [&](const TraceRow& row) { return allotments.weighed_whole(row); };
      }
      make(leader, attempt);
    }
    std::vector<TraceRow> trace = leader >= 0 ? made_[leader].trace : std::vector<TraceRow>{};
    const bool failed = leader >= 0 && failures_[leader];
    const std::vector<Allotment> shares = allotments.allot(leader < 0 || failed ? 0 : made_[leader].map.domain.size());
    for_each_index(parts_.size(), true, [&](std::size_t p) {
      if (shares[p].is_own) bring_along(p);
      else if (static_cast<std::int32_t>(p) != leader) make(p, attempt_at(shares[p].faces));
    });
    rethrow_failures();
    if (leader >= 0 && parts_.size() > 1) revise(allotments);
    ParameterizeResult result = joined();
    result.asked = asked.value_or(FaceRange{});
    for (const char is_own : brought_along_) result.parts_as_they_are += is_own;
    result.trace = std::move(trace);
    return result;
  }

 private:
  void find_facts() {
    facts_.resize(parts_.size());
    own_.resize(parts_.size());
    for_each_index(parts_.size(), true, [&](std::size_t p) {
      const SourceMesh& mesh = parts_[p].mesh;
      const std::size_t triangles = mesh.triangles.size();
      OwnDomain own;
      if (cones_[p].empty()) own_[p] = map_to_its_faces(mesh);
      own.is_best = own_[p] || triangles <= kTiny;
      if (!own_[p] && triangles <= kSmall) {
        own_[p] = map_to_itself(mesh);
        own.cuts = 2 * static_cast<double>(triangles);
      }
      if (own_[p]) {
        own.faces = own_[p]->domain.size();
        own.distortion = weighed(measure_distortion(mesh, *own_[p]));
      }
      const HalfedgeMesh halfedges =
          make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()));
      facts_[p] = {parts_[p].area, diagonal(bounds_of(mesh.positions)), static_cast<std::int32_t>(triangles),
                   least_domain_faces(topology_of(halfedges)), own};
    });
  }

  /// Of one part by its source, too; several share what cutting may add to all of them.
  std::optional<FaceRange> asked_for() const {
    if (options_.max_domain_faces > 0) return FaceRange{options_.min_domain_faces, options_.max_domain_faces};
    if (parts_.size() == 1 && !facts_.front().own.is_best) return faces_for_source(triangles_);
    return std::nullopt;
  }

  /// Parts that need more domain triangles than they got, or can do with fewer, are made anew.
  void revise(const Allotments& allotments) {
    std::vector<MadePart> was;
    for (const ParameterizeResult& part : made_) {
      was.push_back({static_cast<double>(part.map.domain.size()), weighed(part.distortion),
                     static_cast<double>(part.surface.triangles.size())});
    }
    const std::vector<Allotment> shares = allotments.revised(was);
    for_each_index(parts_.size(), true, [&](std::size_t p) {
      constexpr double kOther = 2;  // so many times as many: a level is four times
      const double faces = shares[p].faces.least;
      if (shares[p].is_own && !brought_along_[p]) bring_along(p);
      if (shares[p].is_own || (faces < kOther * was[p].faces && was[p].faces < kOther * faces)) return;
      make(p, attempt_at(shares[p].faces));
    });
    rethrow_failures();
  }

  Attempt attempt_at(const FaceRange& faces) const {
    // Triangles: fewer don't show a surface's shape; there may be hundreds of parts, each of a few domain triangles.
    constexpr double kLeastProxy = 2000;
    constexpr double kLeastProxyOfMany = 400;
    constexpr double kOfDistortion = 0.3;
    const bool is_one = parts_.size() == 1;
    Attempt attempt{{options_.proxy_triangles_per_face, is_one ? kLeastProxy : kLeastProxyOfMany}, faces};
    attempt.split_cost.mean_area = mean_area_;
    if (is_one) {
      attempt.small_domain = WorkingMap{}.small_domain;
      attempt.split_cost.of_distortion = kOfDistortion;
    }
    return attempt;
  }

  /// Of several parts, any may be made once more.
  SourceMesh mesh_of(std::size_t p) {
    if (parts_.size() > 1) return parts_[p].mesh;
    return std::move(parts_[p].mesh);
  }

  void make(std::size_t p, const Attempt& attempt) {
    try {
      const Progress whole = parts_.size() == 1 ? progress_ : Progress{};
      made_[p] = parameterize_connected(mesh_of(p), options_, cones_[p], attempt, whole);
    } catch (...) {
      failures_[p] = std::current_exception();
    }
    tell_done();
  }

  void rethrow_failures() const {
    for (const std::exception_ptr& failure : failures_) {
      if (failure) std::rethrow_exception(failure);
    }
  }

  void bring_along(std::size_t p) {
    made_[p] = {};
    made_[p].map = std::move(*own_[p]);
    made_[p].surface = mesh_of(p);
    made_[p].least_domain_faces = facts_[p].own.faces;
    brought_along_[p] = 1;
    tell_done();
  }

  void tell_done() {
    if (parts_.size() == 1) return;
    const std::scoped_lock lock(reporting_);
    report(progress_, "parameterizing the parts", static_cast<double>(++done_) / static_cast<double>(parts_.size()));
  }

  ParameterizeResult joined() {
    ParameterizeResult result;
    if (parts_.size() == 1) {
      result = std::move(made_.front());
      if (brought_along_.front()) result.distortion = measure_distortion(result.surface, result.map);
      return result;
    }
    std::vector<double> faces;
    for (const ParameterizeResult& part : made_) {
      result.least_domain_faces += part.least_domain_faces;
      faces.push_back(part.map.domain.size());
    }
    result.energies = weighed_sum(made_, facts_);
    const std::vector<std::int32_t> levels = even_levels(facts_, faces);
    std::vector<MappedPart> mapped;
    mapped.reserve(made_.size());
    for (std::size_t p = 0; p < made_.size(); ++p) {
      mapped.push_back({std::move(made_[p].surface), std::move(made_[p].map), levels[p]});
    }
    MappedPart whole = join_parts(std::move(mapped), names_);
    result.surface = std::move(whole.surface);
    result.map = std::move(whole.map);
    result.distortion = measure_distortion(result.surface, result.map);
    return result;
  }

  const ParameterizeOptions& options_;
  const Progress& progress_;
  std::int64_t triangles_ = 0;  ///< of the source
  double mean_area_ = 0;        ///< of one of them
  SourceMesh names_;            ///< what a surface of several parts has once
  std::vector<Part> parts_;
  std::vector<std::vector<VertexId>> cones_;          ///< [part]
  std::vector<PartFacts> facts_;                      ///< [part]
  std::vector<std::optional<Parameterization>> own_;  ///< [part] the domain that it brings along
  std::vector<char> brought_along_;                   ///< [part] it has that
  std::vector<ParameterizeResult> made_;              ///< [part]
  std::vector<std::exception_ptr> failures_;          ///< [part]
  std::mutex reporting_;
  std::size_t done_ = 0;
};

}  // namespace

ParameterizeResult parameterize_part_by_part(SourceMesh source, const ParameterizeOptions& options,
                                             const std::vector<VertexId>& cones, const Progress& progress) {
  return PartByPart(std::move(source), options, cones, progress).run();
}

}  // namespace lozenge
