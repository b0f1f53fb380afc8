// Sizes come first, for all else is looked up by them; then every level's samples, borders and mesh, of which vertices,
// edges and irregular vertices must be those that the domain says.
#include "stages/check/check_geometry_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "formats/patches/level_mesh.h"
#include "formats/surface/boundary.h"
#include "formats/surface/mesh_statistics.h"
#include "stages/check/check_adjacency.h"
#include "stages/check/finding.h"

namespace lozenge {

namespace {

/// Calls f(patch, i, j, index) for every sample of the patches that exist on a level.
template <typename F>
void for_each_sample(const GeometryImage& image, std::size_t number, const F& f) {
  const GeometryLevel& level = image.levels[number];
  for (std::int32_t p = 0; p < image.layout.count_on(static_cast<std::int32_t>(number)); ++p) {
    for (std::int32_t j = 0; j < level.samples; ++j) {
      for (std::int32_t i = 0; i < level.samples; ++i) {
        if (has_sample(image.layout.places[p], i, j)) f(p, i, j, image.index(level, p, i, j));
      }
    }
  }
}

bool check_layout(const GeometryImage& image, CheckReport& report) {
  Finding wrong;
  const std::int32_t n = image.layout.samples;
  if (n < 2 || ((n - 1) & (n - 2)) != 0) wrong.add([&] { return fmt::format("{} samples a side are not 2^k + 1", n); });
  if (image.columns < 1 || image.size() < 1) {
    wrong.add([&] { return fmt::format("{} columns of tiles for {} patches", image.columns, image.size()); });
  }
  if (image.levels.empty()) wrong.add([] { return std::string("there is no level of detail"); });
  for (std::size_t l = 0; l < image.levels.size() && wrong.none(); ++l) {
    const GeometryLevel& level = image.levels[l];
    const std::int32_t expected = l < 31 ? ((n - 1) >> l) + 1 : 1;
    const std::int32_t rows = image.rows_on(static_cast<std::int32_t>(l));
    const auto texels = static_cast<std::size_t>(image.columns) * rows * level.samples * level.samples;
    if (level.samples != expected || expected < 2 || level.rows != rows || level.positions.size() != texels ||
        level.normals.size() != texels || level.caps.size() != (image.has_caps() ? texels : 0)) {
      wrong.add([&] {
        return fmt::format("level {} has {} samples a side and {} texels, not {} and {}", l, level.samples,
                           level.positions.size(), expected, texels);
      });
    }
  }
  if (wrong.none() && image.levels.back().samples != 2) {
    wrong.add([&] { return fmt::format("the last level has {} samples a side, not 2", image.levels.back().samples); });
  }
  wrong.report_to(report, "layout of tiles and levels",
                  fmt::format("{} patches in {} x {} tiles, {} levels from {} samples a side", image.size(),
                              image.columns, image.rows_on(0), image.levels.size(), n));
  return wrong.none();
}

/// How far outside the bounds a sample may lie, asset's units: rounding, and the small steps that keep samples of
/// different places from being equal.
float slack_of(const Bounds& bounds) {
  double reach = diagonal(bounds);
  for (int axis = 0; axis < 3; ++axis) {
    reach += std::max(std::abs(bounds.low[axis]), std::abs(bounds.high[axis]));
  }
  return static_cast<float>(1e-4 * reach);
}

void check_values(const GeometryImage& image, CheckReport& report) {
  Finding infinite, crooked, outside;
  const float slack = slack_of(image.layout.bounds);
  std::int64_t count = 0;
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const GeometryLevel& level = image.levels[l];
    for_each_sample(image, l, [&](std::int32_t p, std::int32_t i, std::int32_t j, std::size_t at) {
      ++count;
      const auto place = [&] { return fmt::format("level {}, sample ({}, {}) of patch {}", l, i, j, p); };
      const Vec3f& x = level.positions[at];
      if (!is_finite(x)) infinite.add(place);
      if (!is_unit(level.normals[at])) crooked.add(place);
      for (int axis = 0; axis < 3; ++axis) {
        if (x[axis] < image.layout.bounds.low[axis] - slack || x[axis] > image.layout.bounds.high[axis] + slack) {
          outside.add(place);
          break;
        }
      }
    });
  }
  const std::string samples = fmt::format("{} samples", count);
  infinite.report_to(report, "positions are finite", samples);
  crooked.report_to(report, "normals are unit vectors", samples);
  outside.report_to(report, "positions lie inside the source's bounds", samples);
}

/// Half patches are zero where the surface has ended.
void check_beyond(const GeometryImage& image, CheckReport& report) {
  Finding beyond;
  const Vec3f zero(0, 0, 0);
  std::int64_t empty = 0;
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const GeometryLevel& level = image.levels[l];
    for (std::int32_t p = 0; p < image.layout.count_on(static_cast<std::int32_t>(l)); ++p) {
      if (image.layout.places[p].right.exists()) continue;
      for (std::int32_t j = 0; j < level.samples; ++j) {
        for (std::int32_t i = j + 1; i < level.samples; ++i) {
          ++empty;
          const std::size_t at = image.index(level, p, i, j);
          if (same_bits(level.positions[at], zero) && same_bits(level.normals[at], zero)) continue;
          beyond.add([&] { return fmt::format("level {}, sample ({}, {}) of patch {}", l, i, j, p); });
        }
      }
    }
  }
  if (empty > 0) beyond.report_to(report, "nothing is sampled beyond the boundary", fmt::format("{} zeros", empty));
}

/// Marks of caps: 0 or 1, none where there is no sample, the same on both sides of a border.
void check_caps(const GeometryImage& image, CheckReport& report) {
  if (!image.has_caps()) return;
  Finding wrong;
  std::int64_t count = 0;
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const GeometryLevel& level = image.levels[l];
    for (std::int32_t p = 0; p < image.layout.count_on(static_cast<std::int32_t>(l)); ++p) {
      for (std::int32_t k = 0; k < level.samples * level.samples; ++k) {
        const std::int32_t i = k % level.samples;
        const std::int32_t j = k / level.samples;
        const std::uint32_t mark = level.caps[image.index(level, p, i, j)];
        count += mark;
        if (mark <= (has_sample(image.layout.places[p], i, j) ? 1U : 0U)) continue;
        wrong.add([&] { return fmt::format("level {}, sample ({}, {}) of patch {} has {}", l, i, j, p, mark); });
      }
    }
  }
  wrong.report_to(report, "samples on caps are marked", fmt::format("{} samples", count));
}

void check_borders(const GeometryImage& image, CheckReport& report) {
  Finding torn;
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const GeometryLevel& level = image.levels[l];
    const std::int32_t n = level.samples;
    for (std::int32_t p = 0; p < image.layout.count_on(static_cast<std::int32_t>(l)); ++p) {
      for (std::int32_t s = 0; s < 4; ++s) {
        const PatchSide other = image.layout.adjacency[p][s];
        if (other.patch < 0) continue;
        for (std::int32_t k = 0; k < n; ++k) {
          const auto here = sample_on_side(s, k, n);
          const auto there = sample_on_side(other.side, n - 1 - k, n);
          const std::size_t a = image.index(level, p, here[0], here[1]);
          const std::size_t b = image.index(level, other.patch, there[0], there[1]);
          const bool same_marks = level.caps.empty() || level.caps[a] == level.caps[b];
          if (same_marks && same_bits(level.positions[a], level.positions[b]) &&
              same_bits(level.normals[a], level.normals[b])) {
            continue;
          }
          torn.add([&] {
            return fmt::format("level {}: sample ({}, {}) of patch {} differs from ({}, {}) of patch {}", l, here[0],
                               here[1], p, there[0], there[1], other.patch);
          });
        }
      }
    }
  }
  torn.report_to(report, "borders hold the same bits on both sides", "positions and normals, every level");
}

void check_subsamples(const GeometryImage& image, CheckReport& report) {
  Finding wrong;
  for (std::size_t l = 1; l < image.levels.size(); ++l) {
    const GeometryLevel& level = image.levels[l];
    for_each_sample(image, l, [&](std::int32_t p, std::int32_t i, std::int32_t j, std::size_t at) {
      const std::int32_t first = image.layout.first_level(p);
      const std::int32_t step = 1 << (static_cast<std::int32_t>(l) - first);
      const GeometryLevel& finest = image.levels[first];
      const std::size_t from = image.index(finest, p, i * step, j * step);
      if (same_bits(level.positions[at], finest.positions[from]) &&
          same_bits(level.normals[at], finest.normals[from]) &&
          (level.caps.empty() || level.caps[at] == finest.caps[from])) {
        return;
      }
      wrong.add([&] {
        return fmt::format("level {}: sample ({}, {}) of patch {} is not sample ({}, {}) of level {}", l, i, j, p,
                           i * step, j * step, first);
      });
    });
  }
  wrong.report_to(report, "coarser levels are every second sample", fmt::format("{} levels", image.levels.size()));
}

/// Parts have scales of their own: a first level for each patch, ascending, the same all over a part.
void check_first_levels(const GeometryImage& image, CheckReport& report) {
  if (image.layout.first_levels.empty()) return;
  const auto defect = find_first_level_defect(image.layout);
  report.add(
      "every part has one first level", !defect, defect ? *defect : [&] {
        return fmt::format("{} of {} patches begin on a coarser level", image.size() - image.layout.count_on(0),
                           image.size());
      }());
}

/// Vertices of a level that lie on irregular domain vertices, and those beside the boundary: there a half quad is one
/// triangle instead of two.
std::set<std::int32_t> irregular_corners(const GeometryImage& image, const PatchedDomain& domain,
                                         const LevelMesh& mesh) {
  std::set<std::int32_t> found;
  for (std::int32_t p = 0; p < image.size(); ++p) {
    const std::int32_t last = mesh.grids.samples(p) - 1;
    if (domain.is_irregular(image.layout.places[p].a)) found.insert(mesh.vertex(p, 0, 0));
    if (domain.is_irregular(image.layout.places[p].b)) found.insert(mesh.vertex(p, last, last));
    if (image.layout.places[p].right.exists()) continue;
    for (std::int32_t i = 0; i < last; ++i) found.insert(mesh.vertex(p, i, i + 1));
  }
  return found;
}

/// The steps along the diagonals of half patches, ascending: where the level should end, and nowhere else.
std::vector<BoundarySide> diagonals_of(const GeometryImage& image, const LevelMesh& mesh) {
  std::vector<BoundarySide> sides;
  for (std::int32_t p = 0; p < image.size(); ++p) {
    if (image.layout.places[p].right.exists()) continue;
    for (std::int32_t i = 0; i + 1 < mesh.grids.samples(p); ++i) {
      sides.push_back({mesh.vertex(p, i, i), mesh.vertex(p, i + 1, i + 1)});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

void check_surfaces(const GeometryImage& image, CheckReport& report) {
  const PatchedDomain domain = domain_of_patches(image.layout.places);
  Finding open, elsewhere, other_topology, other_vertices;
  std::size_t loops = 0;
  for (std::size_t l = 0; l < image.levels.size(); ++l) {
    const LevelMesh mesh = level_mesh(image, static_cast<int>(l));
    const MeshStatistics s = mesh_statistics({mesh.positions, mesh.triangles});
    const bool boundary_fits = domain.closed() ? s.boundary_edges == 0 : s.boundary_edges > 0;
    if (!boundary_fits || s.tangled_edges > 0 || s.pinched_vertices > 0) {
      open.add([&] {
        return fmt::format(
            "level {} has {} boundary edges, {} edges of too many or turned triangles, {} pinched vertices", l,
            s.boundary_edges, s.tangled_edges, s.pinched_vertices);
      });
      continue;
    }
    if (s.euler != domain.euler()) {
      other_topology.add([&] { return fmt::format("level {} has {}, the domain {}", l, s.euler, domain.euler()); });
    }
    const std::vector<BoundarySide> sides = boundary_sides(mesh.view());
    if (sides != diagonals_of(image, mesh)) {
      elsewhere.add([&] {
        return fmt::format("level {} has {} sides without a neighbour, the diagonals of {} half patches {} steps", l,
                           sides.size(), domain.half_patches, diagonals_of(image, mesh).size());
      });
    }
    if (l == 0) loops = boundary_loops(sides).size();
    const std::vector<std::int32_t> irregular = irregular_vertices(mesh);
    const std::set<std::int32_t> expected = irregular_corners(image, domain, mesh);
    if (!std::equal(irregular.begin(), irregular.end(), expected.begin(), expected.end())) {
      other_vertices.add([&] {
        return fmt::format("level {} has {} irregular vertices, the domain {}", l, irregular.size(), expected.size());
      });
    }
  }
  const std::string levels = fmt::format("{} levels", image.levels.size());
  open.report_to(report,
                 domain.closed() ? "every level is closed, oriented, 2-manifold when welded by bits"
                                 : "every level is an oriented 2-manifold with a boundary when welded by bits",
                 levels);
  if (!domain.closed()) {
    elsewhere.report_to(report, "every level ends on the diagonals of half patches, and nowhere else",
                        fmt::format("{}, {} half patches, {} loop(s)", levels, domain.half_patches, loops));
  }
  other_topology.report_to(report, "every level has the domain's Euler characteristic", std::to_string(domain.euler()));
  other_vertices.report_to(report, "irregular vertices are exactly the domain's", std::to_string(domain.irregular));
}

}  // namespace

CheckReport check_geometry_image(const GeometryImage& image) {
  CheckReport report;
  report.kind = "geometry image";
  if (!check_layout(image, report)) return report;
  const bool adjacent = check_adjacency(image.layout.places, image.layout.adjacency, report);
  check_first_levels(image, report);
  check_values(image, report);
  check_beyond(image, report);
  check_caps(image, report);
  check_subsamples(image, report);
  if (!adjacent) return report;
  check_borders(image, report);
  check_surfaces(image, report);
  return report;
}

}  // namespace lozenge
