// Half-diamonds and half-stars are the patches' own grid, in the order of patches or of stars; faces have a grid of
// their own, whose vertices on sides and corners belong to one triangle and are numbered once.
#include "stages/sample/remesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/level_mesh.h"
#include "stages/sample/surface_samples.h"

namespace lozenge {

namespace {

/// The patches, `rate` steps a side.
PatchSet sampled(const SourceMesh& mesh, const Parameterization& map, std::int32_t rate, const Progress& progress) {
  report(progress, "locating", 0);
  const PatchSampler sampler(mesh, map);
  return sampler.sample(sampler.layout(rate + 1), progress);
}

/// Half-diamonds: the mesh of the patches.
SourceMesh remesh_half_diamonds(const PatchSet& patches) {
  LevelMesh welded = patch_mesh(patches);
  SourceMesh result;
  result.positions = std::move(welded.positions);
  result.triangles = std::move(welded.triangles);
  return result;
}

/// Half-stars: the same triangles, star by star. The short diagonal i + j = N - 1 of a patch is where the stars of its
/// ends meet. In whole steps, where `part_of` asks for places: one triangle in the middle of a boundary edge may lie in
/// both, and belongs to the edge's end.
SourceMesh remesh_half_stars(const PatchSet& patches) {
  const LevelMesh welded = patch_mesh(patches);
  struct Placed {
    DomainVertex star;
    std::int32_t triangle;
    auto operator<=>(const Placed&) const = default;
  };
  std::vector<Placed> order;
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    const PatchPlace& place = patches.layout.places[p];
    const std::int32_t samples = patches.grids.samples(p);
    for_each_patch_triangle(samples, !place.right.exists(), [&](const auto&... corners) {
      const bool near_a = std::max({corners[0] + corners[1]...}) <= samples - 1;
      order.push_back({near_a ? place.a : place.b, static_cast<std::int32_t>(order.size())});
    });
  }
  std::sort(order.begin(), order.end());
  SourceMesh result;
  result.positions = welded.positions;
  for (const Placed& placed : order) result.triangles.push_back(welded.triangles[placed.triangle]);
  return result;
}

/// A triangular grid of steps^2 triangles over every domain triangle: `rate` steps, of parts that count as smaller
/// fewer. Vertices: those of the domain, then the inner ones of every edge from the start to the end of its lower side,
/// then the inner ones of every triangle, row by row.
class FaceGrid {
 public:
  FaceGrid(const Parameterization& map, std::int32_t rate) : map_(map), rate_(rate) {
    const Domain& domain = map.domain;
    edge_of_.resize(3 * domain.triangles.size());
    std::int64_t next = domain.vertex_count;
    for (const DomainSide side : edges(domain)) {
      edge_of_[slot(side)] = {next, true};
      const DomainSide other = domain.neighbour(side);
      if (other.exists()) edge_of_[slot(other)] = {next, false};
      next += steps(side.triangle) - 1;
    }
    for (DomainTriangleId t = 0; t < domain.size(); ++t) {
      first_inner_.push_back(next);
      next += std::int64_t{steps(t) - 1} * (steps(t) - 2) / 2;
    }
    vertex_count_ = next;
  }

  std::int64_t vertex_count() const { return vertex_count_; }
  /// Along a side of the triangle: as the patches have them (`patch_layout`).
  std::int32_t steps(DomainTriangleId t) const {
    const int halvings = std::countr_zero(static_cast<std::uint32_t>(rate_));
    return rate_ >> std::min(map_.first_level(t), halvings);
  }

  /// The vertex `b` steps towards corner 1 and `c` towards corner 2 of the triangle's corner 0.
  std::int64_t vertex(DomainTriangleId t, std::int32_t b, std::int32_t c) const {
    const std::int32_t all = steps(t);
    const std::array<std::int32_t, 3> weights{all - b - c, b, c};
    for (int corner = 0; corner < 3; ++corner) {
      if (weights[corner] == all) return map_.domain.corner(t, corner);
    }
    for (int side = 0; side < 3; ++side) {
      if (weights[(side + 2) % 3] != 0) continue;
      const auto [first, forward] = edge_of_[slot({t, side})];
      return first + (forward ? weights[(side + 1) % 3] : weights[side]) - 1;
    }
    const std::int64_t before = static_cast<std::int64_t>(c - 1) * (all - 1) - static_cast<std::int64_t>(c - 1) * c / 2;
    return first_inner_[t] + before + b - 1;
  }

 private:
  struct EdgeUse {
    std::int64_t first = -1;  ///< its first inner vertex
    bool forward = true;
  };
  static std::size_t slot(DomainSide s) { return 3 * static_cast<std::size_t>(s.triangle) + s.side; }

  const Parameterization& map_;
  std::int32_t rate_;
  std::vector<EdgeUse> edge_of_;           ///< [3 * triangle + side]
  std::vector<std::int64_t> first_inner_;  ///< [triangle]
  std::int64_t vertex_count_ = 0;
};

SourceMesh remesh_faces(const SourceMesh& mesh, const Parameterization& map, std::int32_t rate,
                        const Progress& progress) {
  const FaceGrid grid(map, rate);
  const SurfaceSampler sampler(mesh, map);
  // Each vertex is computed once, in the lowest triangle that holds it.
  std::vector<std::int32_t> owners(static_cast<std::size_t>(grid.vertex_count()), -1);
  const auto for_each_vertex = [&](DomainTriangleId t, const auto& visit) {
    const std::int32_t steps = grid.steps(t);
    for (std::int32_t c = 0; c <= steps; ++c) {
      for (std::int32_t b = 0; b + c <= steps; ++b) visit(static_cast<std::size_t>(grid.vertex(t, b, c)), b, c);
    }
  };
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for_each_vertex(t, [&](std::size_t v, std::int32_t, std::int32_t) {
      if (owners[v] < 0) owners[v] = t;
    });
  }
  SourceMesh result;
  result.positions.resize(owners.size());
  for_each_index(map.domain.size(), progress, "remeshing", [&](std::size_t n) {
    const auto t = static_cast<DomainTriangleId>(n);
    const std::int32_t steps = grid.steps(t);
    for_each_vertex(t, [&](std::size_t v, std::int32_t b, std::int32_t c) {
      if (owners[v] != t) return;
      const DomainPoint place =
          make_point(t, static_cast<double>(steps - b - c) / steps, static_cast<double>(b) / steps);
      result.positions[v] = sampler.at(place).position;
    });
  });
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    const std::int32_t steps = grid.steps(t);
    const auto vertex = [&](std::int32_t b, std::int32_t c) { return static_cast<VertexId>(grid.vertex(t, b, c)); };
    for (std::int32_t c = 0; c < steps; ++c) {
      for (std::int32_t b = 0; b + c < steps; ++b) {
        result.triangles.push_back({vertex(b, c), vertex(b + 1, c), vertex(b, c + 1)});
        if (b + c + 1 < steps) result.triangles.push_back({vertex(b + 1, c), vertex(b + 1, c + 1), vertex(b, c + 1)});
      }
    }
  }
  return result;
}

}  // namespace

SourceMesh remesh(const SourceMesh& mesh, const Parameterization& map, const RemeshOptions& options,
                  const Progress& progress) {
  if (options.rate < 1 || options.rate > kMostRate) {
    throw Error(ExitCode::kUsage, "the sampling rate of a remesh is " + std::to_string(options.rate) + "; give 1 to " +
                                      std::to_string(kMostRate));
  }
  // Three halves of a triangle's patches, or the triangle itself, or the kites of its corners: the largest number of
  // vertices.
  const double triangles = 3.0 * map.domain.size() * options.rate * options.rate;
  if (triangles > 1e9) {
    throw Error(ExitCode::kLimit, mesh.origin + ": a remesh of " +
                                      std::to_string(static_cast<std::int64_t>(triangles)) +
                                      " triangles is too large; take a lower rate");
  }
  SourceMesh result;
  switch (options.partition) {
    case Partition::kFaces:
      result = remesh_faces(mesh, map, options.rate, progress);
      break;
    case Partition::kHalfDiamonds:
      result = remesh_half_diamonds(sampled(mesh, map, options.rate, progress));
      break;
    case Partition::kHalfStars:
      result = remesh_half_stars(sampled(mesh, map, options.rate, progress));
      break;
  }
  result.scene_name = mesh.scene_name;
  result.origin = mesh.origin;
  return result;
}

}  // namespace lozenge
