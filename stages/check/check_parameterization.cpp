// Why these lines prove that the map is one-to-one and onto: every source triangle has a flat image that isn't folded;
// images of triangles that share an edge agree on its length, so they fit together along it; source vertices cover the
// cones, so no image has a cone inside. Where the surface ends, the sides of its triangles run along sides of the
// domain that have no neighbour. The images therefore form a branched covering of the domain, and where their areas add
// up to the area of each of its components exactly, it has one sheet. All of it in integers (domain_point.h).
#include "stages/check/check_parameterization.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "formats/base/parallel.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/check/finding.h"

namespace lozenge {

namespace {

using Images = std::vector<std::optional<Development>>;

std::string decimal(LatticeArea value) {
  if (value == 0) return "0";
  const bool negative = value < 0;
  std::string digits;
  for (; value != 0; value /= 10) digits += static_cast<char>('0' + std::abs(static_cast<int>(value % 10)));
  if (negative) digits += '-';
  return {digits.rbegin(), digits.rend()};
}

/// Everything that must hold before an image can be looked at. \return whether it does
bool check_values(const SourceMesh& mesh, const Parameterization& map, CheckReport& report) {
  const bool complete = map.phi.size() == mesh.positions.size();
  report.add("a position for every vertex", complete,
             fmt::format("{} positions for {} vertices", map.phi.size(), mesh.positions.size()));

  Finding stray;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const VertexId v : mesh.triangles[t]) {
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.positions.size()) {
        stray.add([&] { return fmt::format("triangle {} names vertex {}, which does not exist", t, v); });
      }
    }
  }
  stray.report_to(report, "triangles name existing vertices", fmt::format("{} triangles", mesh.triangles.size()));

  const auto defect =
      map.domain.triangles.empty() ? std::optional<std::string>("it has no triangles") : find_defect(map.domain);
  report.add("sound domain", !defect,
             defect.value_or(fmt::format("{} triangles, {} vertices, adjacency reciprocal", map.domain.size(),
                                         map.domain.vertex_count)));

  Finding off;
  for (std::size_t v = 0; v < map.phi.size(); ++v) {
    const DomainPoint& p = map.phi[v];
    const auto on_lattice = [](double x) {
      const double steps = x * static_cast<double>(kLatticeOne);
      return x >= 0 && x <= 1 && steps == std::floor(steps);
    };
    if (p.triangle < 0 || p.triangle >= map.domain.size() || !on_lattice(p.alpha) || !on_lattice(p.beta) ||
        p.gamma() < 0) {
      off.add([&] { return fmt::format("vertex {} lies at ({}, {}, {})", v, p.triangle, p.alpha, p.beta); });
    }
  }
  off.report_to(report, "positions on the domain's lattice", "multiples of 2^-40, none below 0");
  return complete && stray.none() && !defect && off.none();
}

Images develop_all(const SourceMesh& mesh, const Parameterization& map) {
  Images images(mesh.triangles.size());
  for_each_part(images.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) images[t] = image_of(mesh, map, static_cast<TriangleId>(t));
  });
  return images;
}

LatticeArea area_of(const Development& image) {
  return doubled_area(image.corners[0], image.corners[1], image.corners[2]);
}

bool check_images(const Images& images, CheckReport& report) {
  Finding missing;
  Finding folded;
  for (std::size_t t = 0; t < images.size(); ++t) {
    if (!images[t]) {
      missing.add([&] { return fmt::format("no interpolation domain holds triangle {}", t); });
    } else if (area_of(*images[t]) <= 0) {
      folded.add([&] {
        return fmt::format("triangle {} has the image area {} near domain triangle {}", t,
                           static_cast<double>(area_of(*images[t])) / static_cast<double>(kUnitTriangleDoubledArea),
                           images[t]->home);
      });
    }
  }
  missing.report_to(report, "an image for every triangle", fmt::format("{} triangles", images.size()));
  folded.report_to(report, "no folded triangle", fmt::format("{} triangles, areas exact", images.size()));
  return missing.none();
}

/// [domain triangle] the lowest triangle of its component.
std::vector<DomainTriangleId> components_of(const Domain& domain) {
  std::vector<DomainTriangleId> component(domain.triangles.size(), -1);
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    if (component[t] >= 0) continue;
    std::vector<DomainTriangleId> waiting{t};
    component[t] = t;
    while (!waiting.empty()) {
      const DomainTriangleId at = waiting.back();
      waiting.pop_back();
      for (const DomainSide n : domain.triangles[at].neighbours) {
        if (!n.exists() || component[n.triangle] >= 0) continue;
        component[n.triangle] = t;
        waiting.push_back(n.triangle);
      }
    }
  }
  return component;
}

void check_area_sums(const Domain& domain, const Images& images, CheckReport& report) {
  const std::vector<DomainTriangleId> component = components_of(domain);
  std::vector<LatticeArea> excess(component.size(), 0);
  for (const auto& image : images) excess[component[image->home]] += area_of(*image);
  for (const DomainTriangleId c : component) excess[c] -= kUnitTriangleDoubledArea;
  Finding wrong;
  std::int64_t count = 0;
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    if (component[t] != t) continue;
    ++count;
    if (excess[t] != 0) {
      wrong.add([&] {
        return fmt::format("on the component of domain triangle {} they are {} lattice units too {} ({:.3g} triangles)",
                           t, decimal(excess[t] < 0 ? -excess[t] : excess[t]), excess[t] > 0 ? "large" : "small",
                           static_cast<double>(excess[t]) / static_cast<double>(kUnitTriangleDoubledArea));
      });
    }
  }
  wrong.report_to(report, "image areas add up to the domain's",
                  fmt::format("exactly, on each of {} component(s)", count));
}

void check_cones(const Parameterization& map, CheckReport& report) {
  std::vector<bool> covered(static_cast<std::size_t>(map.domain.vertex_count), false);
  for (const DomainPoint& p : map.phi) {
    if (const DomainVertex v = vertex_at(map.domain, p); v >= 0) covered[v] = true;
  }
  std::vector<bool> on_boundary(covered.size(), false);
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      if (map.domain.neighbour({t, s}).exists()) continue;
      on_boundary[map.domain.start({t, s})] = on_boundary[map.domain.end({t, s})] = true;
    }
  }
  const std::vector<std::int32_t> valence = valences(map.domain);
  Finding bare;
  for (std::size_t v = 0; v < covered.size(); ++v) {
    if (valence[v] != (on_boundary[v] ? 3 : 6) && !covered[v]) {
      bare.add([&] { return fmt::format("domain vertex {} of valence {} has none", v, valence[v]); });
    }
  }
  bare.report_to(report, "a source vertex on every irregular domain vertex",
                 fmt::format("{} irregular vertices", count_irregular(map.domain)));
}

LatticeArea squared_length(LatticePoint e) {
  return static_cast<LatticeArea>(e.u) * e.u + static_cast<LatticeArea>(e.u) * e.v +
         static_cast<LatticeArea>(e.v) * e.v;
}

/// One side of an image.
struct ImageEdge {
  VertexId low;
  VertexId high;
  std::int64_t corner;  ///< 3 triangle + side
  LatticeArea squared;
};

void check_edge_lengths(const SourceMesh& mesh, const Images& images, CheckReport& report) {
  std::vector<ImageEdge> edges;
  edges.reserve(images.size() * 3);
  for (std::size_t t = 0; t < images.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const VertexId a = mesh.triangles[t][s];
      const VertexId b = mesh.triangles[t][(s + 1) % 3];
      const auto& c = images[t]->corners;
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::int64_t>(3 * t + s),
                       squared_length(c[(s + 1) % 3] - c[s])});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const ImageEdge& x, const ImageEdge& y) {
    if (x.low != y.low) return x.low < y.low;
    return x.high != y.high ? x.high < y.high : x.corner < y.corner;
  });
  Finding torn;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const ImageEdge& x = edges[i];
    const ImageEdge& y = edges[i + 1];
    if (x.low != y.low || x.high != y.high || x.squared == y.squared) continue;
    torn.add([&] {
      return fmt::format("edge {}-{} is {:.6g} long in triangle {} and {:.6g} in triangle {}", x.low, x.high,
                         std::sqrt(static_cast<double>(x.squared)) / static_cast<double>(kLatticeOne), x.corner / 3,
                         std::sqrt(static_cast<double>(y.squared)) / static_cast<double>(kLatticeOne), y.corner / 3);
    });
  }
  torn.report_to(report, "edges have one length from both sides", "squared lattice lengths equal");
}

/// A place on a side of the domain that has no neighbour: how far from the side's start, in lattice steps.
struct OnBoundary {
  DomainSide side;
  std::int64_t along = 0;
};

/// The sides of the domain without a neighbour, from vertex to vertex.
class DomainBoundary {
 public:
  explicit DomainBoundary(const Domain& domain)
      : domain_(domain), corners_(corner_of_each_vertex(domain)), valences_(valences(domain)) {}

  /// The side that leaves the vertex, or none where it lies inside.
  DomainSide leaving(DomainVertex v) const {
    const DomainSide side{corners_[v].triangle, corners_[v].corner};
    return domain_.neighbour(side).exists() ? DomainSide{} : side;
  }

  /// In a vertex, on the side that leaves it.
  std::optional<OnBoundary> place_of(const DomainPoint& p) const {
    if (const DomainVertex v = vertex_at(domain_, p); v >= 0) {
      const DomainSide side = leaving(v);
      return side.exists() ? std::optional(OnBoundary{side, 0}) : std::nullopt;
    }
    const LatticePoint at = lattice_point(p);
    const std::array<std::int64_t, 3> weights{kLatticeOne - at.u - at.v, at.u, at.v};
    for (int s = 0; s < 3; ++s) {
      if (weights[(s + 2) % 3] == 0 && !domain_.neighbour({p.triangle, s}).exists()) {
        return OnBoundary{{p.triangle, s}, weights[(s + 1) % 3]};
      }
    }
    return std::nullopt;
  }

  /// The way along the boundary from one place to another, as long as it is straight: through vertices of three
  /// triangles alone. A side of a triangle spans two vertices at most.
  std::optional<std::int64_t> straight_way(const DomainPoint& from, const DomainPoint& to) const {
    const std::optional<OnBoundary> start = place_of(from);
    const std::optional<OnBoundary> end = place_of(to);
    if (!start || !end) return std::nullopt;
    const DomainVertex end_vertex = vertex_at(domain_, to);
    std::int64_t way = -start->along;
    DomainSide side = start->side;
    constexpr int kMostSides = 3;
    for (int n = 0; n < kMostSides; ++n, way += kLatticeOne) {
      if (end_vertex >= 0 && domain_.end(side) == end_vertex) return way + kLatticeOne;
      if (end_vertex < 0 && end->side == side && (n > 0 || end->along > start->along)) return way + end->along;
      if (valences_[domain_.end(side)] != 3) return std::nullopt;
      side = leaving(domain_.end(side));
    }
    return std::nullopt;
  }

 private:
  const Domain& domain_;
  std::vector<DomainCorner> corners_;
  std::vector<std::int32_t> valences_;
};

/// In how many loops the domain ends.
std::int64_t count_loops(const Domain& domain) {
  std::vector<BoundarySide> sides;
  for (const DomainSide side : edges(domain)) {
    if (!domain.neighbour(side).exists()) sides.push_back({domain.start(side), domain.end(side)});
  }
  std::sort(sides.begin(), sides.end());
  return static_cast<std::int64_t>(boundary_loops(sides).size());
}

void check_boundary(const SourceMesh& mesh, const Parameterization& map, const Images& images, CheckReport& report) {
  const std::vector<BoundarySide> sides = boundary_sides(mesh.triangles);
  const std::int64_t domain_loops = count_loops(map.domain);
  if (sides.empty() && domain_loops == 0) return;
  const DomainBoundary boundary(map.domain);
  Finding astray;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const BoundarySide side{mesh.triangles[t][s], mesh.triangles[t][(s + 1) % 3]};
      if (!std::binary_search(sides.begin(), sides.end(), side)) continue;
      const auto way = boundary.straight_way(map.phi[side[0]], map.phi[side[1]]);
      const LatticeArea squared = squared_length(images[t]->corners[(s + 1) % 3] - images[t]->corners[s]);
      if (way && static_cast<LatticeArea>(*way) * *way == squared) continue;
      astray.add([&] { return fmt::format("the surface ends between vertices {} and {}", side[0], side[1]); });
    }
  }
  const auto loops = static_cast<std::int64_t>(boundary_loops(sides).size());
  if (loops != domain_loops) {
    astray.add([&] { return fmt::format("the source has {} boundary loop(s), the domain {}", loops, domain_loops); });
  }
  astray.report_to(report, "the source's boundary runs along the domain's",
                   fmt::format("{} sides in {} loop(s)", sides.size(), loops));
}

}  // namespace

CheckReport check_parameterization(const SourceMesh& mesh, const Parameterization& map) {
  CheckReport report;
  report.kind = "parameterization";
  if (!check_values(mesh, map, report)) return report;

  const MeshStatistics s = mesh_statistics({mesh.positions, mesh.triangles});
  const std::int32_t euler = euler_characteristic(map.domain);
  report.add("Euler characteristic of the source", euler == s.euler,
             fmt::format("domain {}, source {}", euler, s.euler));
  check_cones(map, report);
  const Images images = develop_all(mesh, map);
  if (!check_images(images, report)) return report;
  check_area_sums(map.domain, images, report);
  check_edge_lengths(mesh, images, report);
  check_boundary(mesh, map, images, report);
  return report;
}

}  // namespace lozenge
