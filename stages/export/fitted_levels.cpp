#include "stages/export/fitted_levels.h"

#include <algorithm>

#include "formats/base/error.h"
#include "formats/patches/source_level.h"
#include "formats/surface/distinct_positions.h"
#include "formats/surface/source_mesh.h"
#include "stages/export/charted_scene.h"
#include "stages/export/exposure.h"
#include "stages/export/fit.h"
#include "stages/export/thin.h"
#include "stages/export/vertex_origins.h"

namespace lozenge {

namespace {

/// A source of so many times the triangles of its finest fitted level is thinned out to so many times as many.
constexpr std::int64_t kDense = 6;
constexpr std::int64_t kKept = 4;

bool same_place(const PatchPlace& a, const PatchPlace& b) {
  return a.a == b.a && a.b == b.b && a.left == b.left && a.right == b.right;
}

void require_own_map(const SourceSurface& source, const PatchLayout& patches) {
  const std::vector<PatchPlace> places = patch_places(source.map->domain);
  if (std::equal(places.begin(), places.end(), patches.places.begin(), patches.places.end(), same_place)) return;
  throw Error(ExitCode::kUnusableInput,
              patches.origin +
                  ": the geometry image wasn't sampled from this map; give the map file that `lozenge "
                  "sample` was given");
}

/// How wide the strips are that outlines count as, by the diagonal, where the finest level has so many triangles: the
/// fewer there are, the more one sees of outlines and the less of what maps show anyway.
double outline_width(std::int64_t triangles) {
  constexpr double kOfOneTriangle = 1500;
  constexpr double kWidest = 3;
  return std::min(kWidest, kOfOneTriangle / static_cast<double>(std::max<std::int64_t>(triangles, 1)));
}

/// What bends is no other group to a level: what is left is caps and classes of looks.
void join_what_bends(ChartedSurface& surface) {
  for (ChartedTriangle& t : surface.triangles) t.group = std::max(t.group, 0);
}

}  // namespace

FittedLevels::FittedLevels(const SourceSurface& source, const PatchLayout& patches, const MapLayout& layout) {
  require_own_map(source, patches);
  mesh_ = source.mesh;
  bodies_ = &patches.bodies;
  source_ = source_level(*source.mesh, *source.map, patches, layout);
  charts_ = chart_scales(layout, patches.size());
  parts_ = parts_of_patches(patches.adjacency);
  constexpr double kRoundings = 8.0 / (1 << 24);
  least_height_ = kRoundings * std::max(layout.width, layout.height);
  scene_ = std::make_unique<RayScene>(scene_of(source_));
}

ChartedSurface FittedLevels::next(std::int64_t triangles) {
  if (!simplifier_) {
    const auto all = static_cast<std::int64_t>(source_.triangles.size());
    if (all > kDense * triangles) fitted_to_ = thinned(source_, charts_, least_height_, kKept * triangles);
    else fitted_to_ = source_;
    join_what_bends(fitted_to_);
    importance_ = exposure_of(fitted_to_, *scene_);
    const double width = outline_width(triangles) * diagonal(bounds_of(fitted_to_.positions));
    simplifier_ = std::make_unique<Simplifier>(
        fitted_to_, charts_, least_height_,
        SimplifierOptions{.importance = importance_, .outline = outline_edges(fitted_to_, importance_, width)});
  }
  simplifier_->reduce_to(triangles);
  simplifier_->mend_turned();
  has_ended_ = simplifier_->triangle_count() > triangles;
  std::vector<VertexId> stood_for;
  ChartedSurface level = simplifier_->surface(&stood_for);
  fit_to_source(level, fitted_to_, source_, *scene_, {parts_, simplifier_->slipped_patches(), importance_});
  if (!source_.origins.empty()) {
    level.origins = origins_of_level(level, *mesh_, source_, *scene_, stood_for, *bodies_);
  }
  make_distinct(level.positions);
  return level;
}

}  // namespace lozenge
