// Most images lie in one domain triangle. The others are followed from their home across every side behind which they
// overlap the next triangle: two neighbouring triangles make a convex rhombus, so an image that overlaps both crosses
// their common side, and following the sides reaches all of it. An image around a vertex of few triangles may
// reach a triangle twice, in two places.
#include "formats/domain_locator.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "formats/error.h"

namespace lozenge {

namespace {

using LatticeTriangle = std::array<LatticePoint, 3>;

constexpr LatticeTriangle kUnitTriangle{LatticePoint{0, 0}, {kLatticeOne, 0}, {0, kLatticeOne}};

/// Source triangles of one parallel task.
constexpr std::size_t kChunk = 2048;

/// One side of `a` has all of `b` on its outer side (or on it). \pre both counter-clockwise
bool side_separates(const LatticeTriangle& a, const LatticeTriangle& b) {
  for (int s = 0; s < 3; ++s) {
    const LatticePoint from = a[s];
    const LatticePoint to = a[(s + 1) % 3];
    if (std::all_of(b.begin(), b.end(), [&](LatticePoint p) { return doubled_area(from, to, p) <= 0; })) return true;
  }
  return false;
}

/// Two counter-clockwise triangles have inner points in common.
bool overlap(const LatticeTriangle& a, const LatticeTriangle& b) {
  return !side_separates(a, b) && !side_separates(b, a);
}

LatticeTriangle moved(const LatticeTriangle& t, const LatticeMotion& motion) {
  return {motion(t[0]), motion(t[1]), motion(t[2])};
}

/// A domain triangle, and the image as its frame sees it.
struct Visit {
  DomainTriangleId triangle;
  LatticeTriangle image;
  friend bool operator==(const Visit&, const Visit&) = default;
};

/// All domain triangles whose inside the image overlaps, its home first.
std::vector<Visit> visits_of(const Domain& domain, const Development& image) {
  std::vector<Visit> seen{{image.home, image.corners}};
  // No image goes around more triangles than share a vertex; a longer walk can only come from a broken domain.
  const std::size_t most = domain.triangles.size() + 3;
  for (std::size_t at = 0; at < seen.size() && seen.size() < most; ++at) {
    for (int side = 0; side < 3; ++side) {
      const DomainSide n = domain.neighbour({seen[at].triangle, side});
      if (!n.exists()) continue;
      const Visit next{n.triangle, moved(seen[at].image, inverse(transition(side, n.side)))};
      if (!overlap(next.image, kUnitTriangle)) continue;
      if (std::find(seen.begin(), seen.end(), next) == seen.end()) seen.push_back(next);
    }
  }
  return seen;
}

std::int64_t cell_of(std::int64_t coordinate, std::int64_t cells) {
  return std::clamp<std::int64_t>(coordinate, 0, kLatticeOne - 1) * cells / kLatticeOne;
}

/// Cells that the image's bounding box touches, clamped to the grid.
struct CellRange {
  std::int64_t u0, u1, v0, v1;
};
CellRange cells_of(const LatticeTriangle& t, std::int64_t cells) {
  const auto [u0, u1] = std::minmax({t[0].u, t[1].u, t[2].u});
  const auto [v0, v1] = std::minmax({t[0].v, t[1].v, t[2].v});
  return {cell_of(u0, cells), cell_of(u1, cells), cell_of(v0, cells), cell_of(v1, cells)};
}

/// Doubled areas of the triangles between `p` and each side, by the opposite corner; none below 0 where `p` is inside.
std::array<LatticeArea, 3> areas_at(const LatticeTriangle& t, LatticePoint p) {
  return {doubled_area(t[1], t[2], p), doubled_area(t[2], t[0], p), doubled_area(t[0], t[1], p)};
}

}  // namespace

Vec3d position_at(const SourceMesh& mesh, const SurfacePoint& p) {
  const auto& [a, b, c] = mesh.triangles[p.triangle];
  return Vec3d(mesh.positions[a]) * p.weights.x + Vec3d(mesh.positions[b]) * p.weights.y +
         Vec3d(mesh.positions[c]) * p.weights.z;
}

DomainPoint domain_point_at(const PatchPlace& place, double u, double v) {
  // Left of the edge the place is a mixture of a, b and the left barycentre, whose weight is v - u; right of it
  // likewise.
  const bool left = v >= u;
  const double barycentre = std::abs(v - u);
  const double apex = barycentre / 3;
  const double a = 1 - std::max(u, v) + apex;
  const double b = std::min(u, v) + apex;
  const DomainSide side = left ? place.left : place.right;
  std::array<double, 3> weights{};
  weights[side.side] = left ? a : b;
  weights[(side.side + 1) % 3] = left ? b : a;
  weights[(side.side + 2) % 3] = apex;
  return make_point(side.triangle, weights[0], weights[1]);
}

void DomainLocator::note_images(const SourceMesh& mesh, const Parameterization& map, TriangleId t,
                                std::vector<NotedImage>& noted) {
  const std::optional<Development> image = image_of(mesh, map, t);
  if (!image || doubled_area(image->corners[0], image->corners[1], image->corners[2]) <= 0) {
    throw Error(ExitCode::kUnusableInput, mesh.origin + ": the map is broken: triangle " + std::to_string(t) +
                                              (image ? " is folded" : " has no image") +
                                              " on the domain; parameterize the mesh again");
  }
  if (image->span == Span::kFace) {
    noted.push_back({image->home, {t, image->corners}});
    return;
  }
  for (const Visit& visit : visits_of(map.domain, *image)) {
    if (overlap(visit.image, kUnitTriangle)) noted.push_back({visit.triangle, {t, visit.image}});
  }
}

void DomainLocator::sort_by_domain_triangle(const std::vector<std::vector<NotedImage>>& noted,
                                            std::int32_t domain_size) {
  first_image_.assign(static_cast<std::size_t>(domain_size) + 1, 0);
  for (const auto& chunk : noted) {
    for (const NotedImage& n : chunk) ++first_image_[static_cast<std::size_t>(n.where) + 1];
  }
  std::partial_sum(first_image_.begin(), first_image_.end(), first_image_.begin());
  images_.resize(first_image_.back());
  std::vector<std::size_t> next(first_image_.begin(), first_image_.end() - 1);
  for (const auto& chunk : noted) {
    for (const NotedImage& n : chunk) images_[next[n.where]++] = n.image;
  }
}

void DomainLocator::fill_grid(DomainTriangleId where) {
  // About two images a cell, for half of the square is empty.
  const std::size_t count = first_image_[where + 1] - first_image_[where];
  Grid& grid = grids_[where];
  grid.cells = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::sqrt(static_cast<double>(count))));
  grid.first_list = list_starts_.size();
  std::vector<std::uint32_t> starts(static_cast<std::size_t>(grid.cells * grid.cells) + 1, 0);
  const auto for_each_cell = [&](std::size_t image, const auto& visit) {
    const CellRange range = cells_of(images_[image].corners, grid.cells);
    for (std::int64_t v = range.v0; v <= range.v1; ++v) {
      for (std::int64_t u = range.u0; u <= range.u1; ++u) visit(static_cast<std::size_t>(v * grid.cells + u));
    }
  };
  for (std::size_t i = first_image_[where]; i < first_image_[where + 1]; ++i) {
    for_each_cell(i, [&](std::size_t cell) { ++starts[cell + 1]; });
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  const auto base = static_cast<std::uint32_t>(entries_.size());
  entries_.resize(entries_.size() + starts.back());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for (std::size_t i = first_image_[where]; i < first_image_[where + 1]; ++i) {
    for_each_cell(i, [&](std::size_t cell) { entries_[base + next[cell]++] = static_cast<std::uint32_t>(i); });
  }
  for (const std::uint32_t start : starts) list_starts_.push_back(base + start);
}

DomainLocator::DomainLocator(const SourceMesh& mesh, const Parameterization& map) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::vector<NotedImage>> noted((count + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, noted.size(), [&](std::size_t chunk) {
    for (std::size_t t = chunk * kChunk; t < std::min(count, (chunk + 1) * kChunk); ++t) {
      note_images(mesh, map, static_cast<TriangleId>(t), noted[chunk]);
    }
  });
  sort_by_domain_triangle(noted, map.domain.size());
  grids_.resize(map.domain.triangles.size());
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) fill_grid(t);
}

SurfacePoint DomainLocator::locate(const DomainPoint& p) const {
  const LatticePoint at = lattice_point(p);
  const Grid& grid = grids_[p.triangle];
  const std::int64_t cell = cell_of(at.v, grid.cells) * grid.cells + cell_of(at.u, grid.cells);
  const std::size_t list = grid.first_list + static_cast<std::size_t>(cell);
  for (std::uint32_t i = list_starts_[list]; i < list_starts_[list + 1]; ++i) {
    const Image& image = images_[entries_[i]];
    const std::array<LatticeArea, 3> areas = areas_at(image.corners, at);
    if (areas[0] < 0 || areas[1] < 0 || areas[2] < 0) continue;
    const auto whole = static_cast<double>(areas[0] + areas[1] + areas[2]);
    return {image.source, Vec3d(static_cast<double>(areas[0]) / whole, static_cast<double>(areas[1]) / whole,
                                static_cast<double>(areas[2]) / whole)};
  }
  return {};
}

}  // namespace lozenge
