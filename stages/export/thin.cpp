// Inside of a patch no vertex is another patch's, so what is left of it goes back under its own numbers.
#include "stages/export/thin.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>

#include "formats/base/parallel.h"
#include "formats/patches/triangle_tile.h"
#include "formats/surface/attribute.h"
#include "stages/export/charted_edges.h"
#include "stages/export/simplify.h"

namespace lozenge {
namespace {

constexpr std::size_t kWidth = kInfluences.components;

/// One patch by itself.
struct PatchSurface {
  ChartedSurface surface;
  std::vector<VertexId> whole;  ///< [vertex] its number in the whole surface
};

PatchSurface patch_of(const ChartedSurface& whole, const std::vector<std::int32_t>& triangles) {
  PatchSurface made;
  std::unordered_map<VertexId, VertexId> number;
  for (const std::int32_t t : triangles) {
    ChartedTriangle& own = made.surface.triangles.emplace_back(whole.triangles[t]);
    own.group = std::max(own.group, 0);
    for (ChartedCorner& c : own.corners) {
      const auto [at, is_new] = number.try_emplace(c.vertex, static_cast<VertexId>(made.whole.size()));
      if (is_new) {
        made.whole.push_back(c.vertex);
        made.surface.positions.push_back(whole.positions[c.vertex]);
        if (!whole.influences.empty()) {
          const auto first = whole.influences.begin() + static_cast<std::ptrdiff_t>(kWidth * c.vertex);
          made.surface.influences.insert(made.surface.influences.end(), first, first + kWidth);
        }
      }
      c.vertex = at->second;
    }
  }
  return made;
}

/// Sides of one triangle alone: each keeps it.
std::int64_t count_ends(const ChartedSurface& surface) {
  std::int64_t count = 0;
  for_each_edge(sides_by_edge(surface),
                [&](std::span<const ChartedSide> sides) { count += sides.size() == 1 ? 1 : 0; });
  return count;
}

}  // namespace

ChartedSurface thinned(const ChartedSurface& surface, const std::vector<ChartScale>& charts, double least_height,
                       std::int64_t triangles) {
  const auto by_patch = triangles_by_patch(surface, static_cast<std::int32_t>(charts.size()));
  const double share = static_cast<double>(triangles) / static_cast<double>(surface.triangles.size());
  ChartedSurface made;
  made.positions = surface.positions;
  made.influences = surface.influences;
  std::vector<PatchSurface> left(by_patch.size());
  for_each_index(by_patch.size(), true, [&](std::size_t p) {
    PatchSurface patch = patch_of(surface, by_patch[p]);
    const std::int64_t ends = count_ends(patch.surface);
    Simplifier simplifier(std::move(patch.surface), charts, least_height, {.lines = Lines::kStay});
    const auto inside = static_cast<std::int64_t>(share * static_cast<double>(by_patch[p].size()));
    simplifier.reduce_to(ends + inside);
    std::vector<VertexId> origins;
    ChartedSurface coarse = simplifier.surface(&origins);
    left[p].surface = std::move(coarse);
    for (const VertexId v : origins) left[p].whole.push_back(patch.whole[v]);
  });
  // Vertices on borders are what they were in each of their patches.
  for (const PatchSurface& patch : left) {
    for (std::size_t v = 0; v < patch.whole.size(); ++v) {
      const auto whole = static_cast<std::size_t>(patch.whole[v]);
      made.positions[whole] = patch.surface.positions[v];
      if (!made.influences.empty()) {
        std::copy_n(&patch.surface.influences[kWidth * v], kWidth, &made.influences[kWidth * whole]);
      }
    }
    for (ChartedTriangle t : patch.surface.triangles) {
      for (ChartedCorner& c : t.corners) c.vertex = patch.whole[c.vertex];
      made.triangles.push_back(t);
    }
  }
  return made;
}

}  // namespace lozenge
