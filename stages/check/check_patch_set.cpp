// Sizes and adjacency first; then each sample by itself, and both sides of each border.
#include "stages/check/check_patch_set.h"

#include <fmt/format.h>

#include <cmath>

#include "stages/check/check_adjacency.h"
#include "stages/check/finding.h"

namespace lozenge {

namespace {

bool check_sizes(const PatchSet& patches, CheckReport& report) {
  const std::int32_t n = patches.layout.samples;
  const bool power = n >= 2 && ((n - 1) & (n - 2)) == 0;
  const bool grids = power && !find_first_level_defect(patches.layout) && patches.grids.patches() == patches.size();
  const std::size_t expected = grids ? patches.grids.size() : 0;
  const bool sizes = patches.positions.size() == expected && patches.normals.size() == expected &&
                     patches.source_triangles.size() == expected && patches.source_weights.size() == expected &&
                     (patches.caps.empty() || patches.caps.size() == expected);
  const bool fine = grids && sizes && patches.size() > 0;
  report.add("grids of 2^k + 1 samples a side", fine,
             fmt::format("{} patches of {} x {} samples{}", patches.size(), n, n, sizes ? "" : ", but other arrays"));
  return fine;
}

void check_values(const PatchSet& patches, CheckReport& report) {
  Finding infinite, crooked, unlocated, beyond;
  const Vec3f zero(0, 0, 0);
  std::int64_t empty = 0;
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.grids.samples(p); ++j) {
      for (std::int32_t i = 0; i < patches.grids.samples(p); ++i) {
        const std::size_t at = patches.index(p, i, j);
        const auto place = [&] { return fmt::format("sample ({}, {}) of patch {}", i, j, p); };
        if (!has_sample(patches.layout.places[p], i, j)) {
          ++empty;
          const bool holds_nothing = same_bits(patches.positions[at], zero) && same_bits(patches.normals[at], zero) &&
                                     patches.source_triangles[at] == -1 &&
                                     (patches.caps.empty() || patches.caps[at] == 0);
          if (!holds_nothing) beyond.add(place);
          continue;
        }
        if (!is_finite(patches.positions[at])) infinite.add(place);
        if (!is_unit(patches.normals[at])) crooked.add(place);
        const Vec3f& w = patches.source_weights[at];
        const double sum = static_cast<double>(w.x) + w.y + w.z;
        const bool inside = w.x >= 0 && w.y >= 0 && w.z >= 0 && std::abs(sum - 1) < 1e-6;
        if (patches.source_triangles[at] < 0 || !inside) unlocated.add(place);
      }
    }
  }
  const std::string count = fmt::format("{} samples", patches.positions.size());
  infinite.report_to(report, "positions are finite", count);
  crooked.report_to(report, "normals are unit vectors", count);
  unlocated.report_to(report, "every sample lies in a source triangle", count);
  if (empty > 0) beyond.report_to(report, "nothing is sampled beyond the boundary", fmt::format("{} zeros", empty));
}

void check_borders(const PatchSet& patches, CheckReport& report) {
  Finding torn;
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t s = 0; s < 4; ++s) {
      const PatchSide other = patches.layout.adjacency[p][s];
      if (other.patch < 0) continue;
      const std::int32_t n = patches.grids.samples(p);
      for (std::int32_t k = 0; k < n; ++k) {
        const auto [i, j] = sample_on_side(s, k, n);
        const auto [oi, oj] = sample_on_side(other.side, n - 1 - k, n);
        const std::size_t a = patches.index(p, i, j);
        const std::size_t b = patches.index(other.patch, oi, oj);
        if (!same_bits(patches.positions[a], patches.positions[b]) ||
            !same_bits(patches.normals[a], patches.normals[b])) {
          torn.add([&, x = i, y = j, ox = oi, oy = oj] {
            return fmt::format("sample ({}, {}) of patch {} differs from ({}, {}) of patch {}", x, y, p, ox, oy,
                               other.patch);
          });
        }
      }
    }
  }
  torn.report_to(report, "borders hold the same bits on both sides", "positions and normals");
}

}  // namespace

CheckReport check_patch_set(const PatchSet& patches) {
  CheckReport report;
  report.kind = "patch set";
  if (!check_sizes(patches, report)) return report;
  const bool adjacent = check_adjacency(patches.layout.places, patches.layout.adjacency, report);
  check_values(patches, report);
  if (adjacent) check_borders(patches, report);
  return report;
}

}  // namespace lozenge
