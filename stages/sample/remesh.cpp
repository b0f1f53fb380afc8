// Half-diamonds and half-stars are the patches' own grid, in the order of patches or of stars; faces have a grid of
// their own, whose vertices on sides and corners belong to one triangle and are numbered once.
#include "stages/sample/remesh.h"

#include <algorithm>
#include <string>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/level_mesh.h"
#include "stages/sample/surface_samples.h"

namespace lozenge {

namespace {

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
  for (const PatchPlace& place : patches.layout.places) {
    for_each_patch_triangle(patches.layout.samples, !place.right.exists(), [&](const auto&... corners) {
      const bool near_a = std::max({corners[0] + corners[1]...}) <= patches.layout.samples - 1;
      order.push_back({near_a ? place.a : place.b, static_cast<std::int32_t>(order.size())});
    });
  }
  std::sort(order.begin(), order.end());
  SourceMesh result;
  result.positions = welded.positions;
  for (const Placed& placed : order) result.triangles.push_back(welded.triangles[placed.triangle]);
  return result;
}

/// A triangular grid of rate^2 triangles over every domain triangle. Vertices: those of the domain, then the inner ones
/// of every edge from the start to the end of its lower side, then the inner ones of every triangle, row by row.
class FaceGrid {
 public:
  FaceGrid(const Domain& domain, std::int32_t rate) : domain_(domain), rate_(rate) {
    edge_of_.resize(3 * domain.triangles.size());
    const std::vector<DomainSide> all = edges(domain);
    for (std::size_t e = 0; e < all.size(); ++e) {
      edge_of_[slot(all[e])] = {static_cast<std::int64_t>(e), true};
      const DomainSide other = domain.neighbour(all[e]);
      if (other.exists()) edge_of_[slot(other)] = {static_cast<std::int64_t>(e), false};
    }
    first_inner_ = domain.vertex_count + static_cast<std::int64_t>(all.size()) * (rate - 1);
  }

  std::int64_t vertex_count() const { return first_inner_ + inner_per_triangle() * domain_.size(); }

  /// The vertex `b` steps towards corner 1 and `c` towards corner 2 of the triangle's corner 0.
  std::int64_t vertex(DomainTriangleId t, std::int32_t b, std::int32_t c) const {
    const std::array<std::int32_t, 3> weights{rate_ - b - c, b, c};
    for (int corner = 0; corner < 3; ++corner) {
      if (weights[corner] == rate_) return domain_.corner(t, corner);
    }
    for (int side = 0; side < 3; ++side) {
      if (weights[(side + 2) % 3] == 0) return on_edge({t, side}, weights[(side + 1) % 3]);
    }
    const std::int64_t before =
        static_cast<std::int64_t>(c - 1) * (rate_ - 1) - static_cast<std::int64_t>(c - 1) * c / 2;
    return first_inner_ + inner_per_triangle() * t + before + b - 1;
  }

 private:
  struct EdgeUse {
    std::int64_t edge = -1;
    bool forward = true;
  };
  static std::size_t slot(DomainSide s) { return 3 * static_cast<std::size_t>(s.triangle) + s.side; }
  std::int64_t inner_per_triangle() const { return static_cast<std::int64_t>(rate_ - 1) * (rate_ - 2) / 2; }
  std::int64_t on_edge(DomainSide side, std::int32_t steps) const {
    const auto [edge, forward] = edge_of_[slot(side)];
    return domain_.vertex_count + edge * (rate_ - 1) + (forward ? steps : rate_ - steps) - 1;
  }

  const Domain& domain_;
  std::int32_t rate_;
  std::vector<EdgeUse> edge_of_;  ///< [3 * triangle + side]
  std::int64_t first_inner_ = 0;
};

SourceMesh remesh_faces(const SourceMesh& mesh, const Parameterization& map, std::int32_t rate,
                        const Progress& progress) {
  const FaceGrid grid(map.domain, rate);
  const SurfaceSampler sampler(mesh, map);
  // Each vertex is computed once, in the lowest triangle that holds it.
  std::vector<std::int32_t> owners(static_cast<std::size_t>(grid.vertex_count()), -1);
  const auto for_each_vertex = [&](DomainTriangleId t, const auto& visit) {
    for (std::int32_t c = 0; c <= rate; ++c) {
      for (std::int32_t b = 0; b + c <= rate; ++b) visit(static_cast<std::size_t>(grid.vertex(t, b, c)), b, c);
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
    for_each_vertex(t, [&](std::size_t v, std::int32_t b, std::int32_t c) {
      if (owners[v] != t) return;
      const DomainPoint place = make_point(t, static_cast<double>(rate - b - c) / rate, static_cast<double>(b) / rate);
      result.positions[v] = sampler.at(place).position;
    });
  });
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    const auto vertex = [&](std::int32_t b, std::int32_t c) { return static_cast<VertexId>(grid.vertex(t, b, c)); };
    for (std::int32_t c = 0; c < rate; ++c) {
      for (std::int32_t b = 0; b + c < rate; ++b) {
        result.triangles.push_back({vertex(b, c), vertex(b + 1, c), vertex(b, c + 1)});
        if (b + c + 1 < rate) result.triangles.push_back({vertex(b + 1, c), vertex(b + 1, c + 1), vertex(b, c + 1)});
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
      result = remesh_half_diamonds(sample_patches(mesh, map, options.rate + 1, progress));
      break;
    case Partition::kHalfStars:
      result = remesh_half_stars(sample_patches(mesh, map, options.rate + 1, progress));
      break;
  }
  result.scene_name = mesh.scene_name;
  result.origin = mesh.origin;
  return result;
}

}  // namespace lozenge
