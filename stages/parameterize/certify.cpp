// Each triangle's exact image, developed from the lattice, is compared with the one that the map has. First the corners
// of what doesn't fit are moved into the middle of what sees them, then its longest sides are split, and so on until
// all fit.
#include "stages/parameterize/certify.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "formats/base/parallel.h"
#include "formats/surface/canonical_form.h"
#include "stages/parameterize/levels/split_long_edges.h"
#include "stages/parameterize/map/boundary.h"
#include "stages/parameterize/map/finished.h"
#include "stages/parameterize/map/homes.h"
#include "stages/parameterize/map/images.h"
#include "stages/parameterize/map/walk.h"
#include "stages/parameterize/relax/local_optimization.h"

namespace lozenge {

namespace {

/// Whether the triangle's exact image is unfolded, and the map's: the sides have the map's lengths, and so those that
/// its neighbours' images have.
bool fits(const WorkingMap& map, const SourceMesh& mesh, const Parameterization& result, TriangleId t) {
  constexpr double kSame = 1e-8;
  const auto image = image_of(mesh, result, t);
  if (!image || doubled_area(image->corners[0], image->corners[1], image->corners[2]) <= 0) return false;
  const FlatImage p = flat_image(map, t);
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const double exact = plane_point(image->corners[next] - image->corners[c]).length2();
    if (!(std::abs(exact - (p[next] - p[c]).length2()) < kSame)) return false;
  }
  return true;
}

/// Source triangles that don't.
std::vector<TriangleId> misfits(const WorkingMap& map, const SourceMesh& mesh, const Parameterization& result) {
  std::vector<char> wrong(mesh.triangles.size(), 0);
  for_each_part(wrong.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) wrong[t] = !fits(map, mesh, result, static_cast<TriangleId>(t));
  });
  std::vector<TriangleId> found;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    if (wrong[t]) found.push_back(static_cast<TriangleId>(t));
  }
  return found;
}

Halfedge longest_side(const WorkingMap& map, TriangleId t) {
  const FlatImage p = flat_image(map, t);
  Halfedge longest = 3 * t;
  double length = 0;
  for (int s = 0; s < 3; ++s) {
    const double here = (p[(s + 1) % 3] - p[s]).length2();
    if (here > length) {
      length = here;
      longest = 3 * t + s;
    }
  }
  return longest;
}

/// The middle of an edge as a home and the motion from there into the frame of the triangle of h; nothing where all
/// three corners are pinned.
std::optional<LineEnd> middle_of(const WorkingMap& map, Halfedge h, const Vec2d& middle) {
  if (map.mesh.twins[h] < 0) {
    const auto found = place_between(map, h, 0.5);
    if (!found) return std::nullopt;
    return LineEnd{found->place.side.triangle, position_of(found->place), found->into_triangle};
  }
  for (const Halfedge corner : {h, next_in_triangle(h), previous_in_triangle(h)}) {
    const VertexId v = map.mesh.start(corner);
    if (map.pin[v] >= 0) continue;
    auto walked = walk(map.domain, map.home[v], map.at[v], inverse(map.chart[corner])(middle));
    if (!walked) continue;
    walked->back = composed(map.chart[corner], walked->back);
    return walked;
  }
  return std::nullopt;
}

/// Splits an edge of the map, all images staying what they are. \return false, with nothing done, where that is
/// impossible
bool split_in_map(WorkingMap& map, Halfedge h) {
  const Halfedge g = map.mesh.twins[h];
  const auto image = [&](Halfedge corner) { return map.chart[corner](map.at[map.mesh.start(corner)]); };
  const Vec2d middle = (image(h) + image(next_in_triangle(h))) / 2;
  const auto place = middle_of(map, h, middle);
  if (!place) return false;
  const UnitMotion across = g >= 0 ? motion_across(map, h) : UnitMotion{};
  const VertexId m = split_edge(map.mesh, h);
  map.home.push_back(-1);
  map.at.push_back({0, 0});
  map.pin.push_back(-1);
  map.next_in.push_back(-1);
  map.last_in.push_back(-1);
  set_home(map, m, place->home, place->at);
  // The halves have the frame of the whole.
  const auto halve = [&](Halfedge side, const UnitMotion& chart) {
    const UnitMotion end = map.chart[next_in_triangle(side)];
    const UnitMotion opposite = map.chart[previous_in_triangle(side)];
    map.chart.insert(map.chart.end(), {chart, end, opposite});
    map.chart[next_in_triangle(side)] = chart;
  };
  halve(h, place->back);
  if (g >= 0) halve(g, composed(across, place->back));
  return true;
}

/// Splits the longest sides of the triangles in the map. \return the mesh with the same edges split; nothing where none
/// can be
std::optional<SourceMesh> split_sides(WorkingMap& map, const SourceMesh& mesh,
                                      const std::vector<TriangleId>& triangles) {
  std::vector<Halfedge> split;
  for (const TriangleId t : triangles) {
    const Halfedge h = longest_side(map, t);
    if (split_in_map(map, h)) split.push_back(h);
  }
  if (split.empty()) return std::nullopt;
  return split_edges(mesh, split);
}

}  // namespace

void make_canonical_with_map(SourceMesh& mesh, Parameterization& map) {
  const std::vector<VertexId> number = make_canonical(mesh);
  std::vector<DomainPoint> phi(mesh.positions.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] >= 0) phi[number[v]] = map.phi[v];
  }
  map.phi = std::move(phi);
}

std::optional<ProvedMap> certified(WorkingMap& map, SourceMesh& mesh) {
  // Most maps need none of either; what several rounds didn't mend, more won't.
  constexpr int kMoves = 3;
  constexpr int kSplits = 8;
  std::optional<SourceMesh> finer;  // once edges were split; where all fails, `mesh` is what it was
  for (int attempt = 0; attempt <= kMoves + kSplits; ++attempt) {
    const SourceMesh& now = finer ? *finer : mesh;
    ProvedMap proved{finished(map), {}};
    proved.distortion = measure_distortion(now, proved.map);
    const std::vector<TriangleId> wrong = misfits(map, now, proved.map);
    if (wrong.empty() && proved.distortion.folded_triangles == 0 && proved.distortion.area_sum_error == 0) {
      if (finer) {
        mesh = std::move(*finer);
        map.positions = &mesh.positions;
        make_canonical_with_map(mesh, proved.map);
      }
      return proved;
    }
    if (attempt < kMoves) {
      std::vector<VertexId> corners;
      for (const TriangleId t : wrong) {
        corners.insert(corners.end(), now.triangles[t].begin(), now.triangles[t].end());
      }
      move_into_kernels(map, corners);
    } else {
      std::optional<SourceMesh> split = split_sides(map, now, wrong);
      if (!split) return std::nullopt;
      finer = std::move(split);
      map.positions = &finer->positions;
      measure_rest_shapes(map);
    }
  }
  return std::nullopt;
}

}  // namespace lozenge
