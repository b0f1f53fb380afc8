// Rows of texels are shared out to threads, each row with a tally of its own; tallies are added up in the order of the
// rows.
#include "stages/bake/atlas_baker.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#include "formats/base/parallel.h"
#include "formats/patches/alike_tiles.h"
#include "formats/patches/shrunk_atlas.h"
#include "formats/surface/facing_hits.h"
#include "formats/surface/nearest_point.h"
#include "stages/bake/patch_looks.h"

namespace lozenge {

namespace {

MapLayout atlas_layout(const BakeOptions& options, const PatchLayout& patches) {
  const std::int32_t size = atlas_size(options, patches);
  return make_map_layout(patches, size, options.gutter ? *options.gutter : default_gutter(patches, size));
}

/// What looks alike lies side by side. Of maps that are baked one at a time, too: nothing depends on which they are.
MapLayout ordered_layout(const BakeOptions& options, const PatchLayout& patches, const Projector& projector,
                         const SourceLook& look) {
  MapLayout layout = atlas_layout(options, patches);
  if (has_made_look(projector.mesh()))
    layout.order = order_of_alike(layout, looks_of_patches(patches, projector, look));
  return layout;
}

}  // namespace

AtlasBaker::AtlasBaker(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
                       const BakeOptions& options, const Textures* textures, const Progress& progress)
    : options_(options),
      progress_(progress),
      projector_(mesh, map, image),
      normals_(mesh),
      look_(mesh, normals_, textures),
      atlas_(image, ordered_layout(options, image.layout, projector_, look_)),
      target_(image, options.level, atlas_.layout()) {
  statistics_.cage_distance = options.cage_distance ? *options.cage_distance : projector_.measured_cage(target_);
}

BakeStatistics AtlasBaker::statistics() const {
  BakeStatistics result = statistics_;
  if (ray_seconds_ > 0) result.rays_per_second = static_cast<double>(result.rays) / ray_seconds_;
  return result;
}

BakedMap AtlasBaker::neutral(MapKind kind, std::int32_t shrink, std::int32_t channels) const {
  return neutral_map(kind, atlas_.layout(), options_.level, shrink, channels);
}

/// Where the surface ends, both it and the source are lines, which rays graze or miss: the correspondence is exact.
std::vector<SourcePoint> AtlasBaker::sources_of(std::span<const AtlasPlace> places, BakeTally& tally) const {
  std::vector<OrientedPoint> points;
  std::vector<std::size_t> looking;  // [point] index of its place
  if (options_.projection == Projection::kRays) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (atlas_.on_boundary(places[i])) continue;
      const Vec2d at = atlas_.share_of(places[i]);
      const TargetSurface::Point from = target_.at(places[i].patch, at.x, at.y);
      points.push_back({from.position, from.frame.normal});
      looking.push_back(i);
    }
  }
  std::vector<RayHit> hits(points.size());
  if (statistics_.cage_distance > 0) {
    tally.rays += facing_hits(projector_.scene(), points, statistics_.cage_distance, projector_.tiny(), hits);
  }
  std::vector<SourcePoint> sources(places.size());
  std::vector<bool> seen(places.size(), false);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].exists()) continue;
    sources[looking[k]] = {hits[k].triangle, hits[k].weights};
    seen[looking[k]] = true;
  }
  tally.fallbacks += std::count_if(hits.begin(), hits.end(), [](const RayHit& hit) { return !hit.exists(); });
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!seen[i]) sources[i] = correspondence(places[i]);
  }
  return sources;
}

SourcePoint AtlasBaker::correspondence(const AtlasPlace& place) const {
  const Vec2d at = atlas_.share_of(place);
  return projector_.correspondence(place.patch, at.x, at.y);
}

SourceFootprint AtlasBaker::footprint(const AtlasPlace& place, double side) const {
  const Vec2d at = atlas_.share_of(place);
  const LocatedPoint located = projector_.locate(place.patch, at.x, at.y);
  const double step = side / atlas_.last(place.patch);
  return {located.point, located.along_u * step, located.along_v * step};
}

SourceFootprint AtlasBaker::footprint_at(const SourcePoint& point, const AtlasPlace& place) const {
  SourceFootprint seen = footprint(place);
  if (seen.at.triangle == point.triangle) return {point, seen.across, seen.down};
  const auto corners_of = [&](TriangleId t) {
    std::array<Vec3d, 3> corners;
    for (int c = 0; c < 3; ++c) corners[c] = Vec3d(projector_.mesh().positions[projector_.mesh().triangles[t][c]]);
    return corners;
  };
  const std::array<Vec3d, 3> here = corners_of(seen.at.triangle);
  const std::array<Vec3d, 3> there = corners_of(point.triangle);
  const auto moved = [&](const Vec3d& weights) {
    return weights_of_step(there, here[0] * weights.x + here[1] * weights.y + here[2] * weights.z);
  };
  return {point, moved(seen.across), moved(seen.down)};
}

void AtlasBaker::bake_rows(std::size_t rows, std::string_view what,
                           const std::function<void(std::size_t, BakeTally&)>& work) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<BakeTally> tallies(rows);
  for_each_index(rows, progress_, what, [&](std::size_t row) { work(row, tallies[row]); });
  std::int64_t rays = 0;
  for (const BakeTally& tally : tallies) {
    statistics_.texels += tally.texels;
    statistics_.fallback_texels += tally.fallbacks;
    statistics_.unused_texels += tally.unused;
    rays += tally.rays;
  }
  statistics_.rays += rays;
  if (rays > 0) ray_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<AtlasBaker::TileRow> AtlasBaker::rows_of_tiles(bool gutters) const {
  std::vector<TileRow> rows;
  for (std::int32_t patch = 0; patch < atlas_.patches(); ++patch) {
    const MapTile& tile = atlas_.tile(patch);
    const std::int32_t first = gutters ? -tile.gutter : 0;
    for (std::int32_t y = first; y < first + (gutters ? tile.size : tile.inner()); ++y) {
      rows.push_back({patch, y, first, first + (gutters ? tile.size : tile.inner())});
    }
  }
  return rows;
}

std::vector<AtlasPlace> AtlasBaker::places_of(const TileRow& row) const {
  std::vector<AtlasPlace> places;
  for (std::int32_t x = row.begin; x < row.end; ++x) {
    const AtlasPlace place{row.patch, static_cast<double>(x), static_cast<double>(row.y)};
    if (atlas_.exists(place)) places.push_back(place);
  }
  return places;
}

void AtlasBaker::bake_places(std::string_view what,
                             const std::function<void(std::span<const AtlasPlace>, BakeTally&)>& work) {
  const std::vector<TileRow> rows = rows_of_tiles(false);
  bake_rows(rows.size(), what, [&](std::size_t row, BakeTally& tally) {
    const std::vector<AtlasPlace> places = places_of(rows[row]);
    tally.texels += static_cast<std::int64_t>(places.size());
    tally.unused += rows[row].end - rows[row].begin - static_cast<std::int32_t>(places.size());
    work(places, tally);
  });
}

void AtlasBaker::bake_inner_texels(std::string_view what,
                                   const std::function<void(const AtlasPlace&, std::size_t)>& work) {
  bake_places(what, [&](std::span<const AtlasPlace> places, BakeTally&) {
    for (const AtlasPlace& place : places) work(place, atlas_.texel_of(place));
  });
}

void AtlasBaker::bake_seen_texels(std::string_view what,
                                  const std::function<void(const AtlasPlace&, std::size_t, const SourcePoint&)>& work) {
  bake_places(what, [&](std::span<const AtlasPlace> places, BakeTally& tally) {
    const std::vector<SourcePoint> sources = sources_of(places, tally);
    for (std::size_t i = 0; i < places.size(); ++i) work(places[i], atlas_.texel_of(places[i]), sources[i]);
  });
}

void AtlasBaker::for_each_texel(std::string_view what,
                                const std::function<void(const AtlasPlace&, std::size_t)>& work) const {
  const std::vector<TileRow> rows = rows_of_tiles(true);
  for_each_index(rows.size(), what.empty() ? Progress() : progress_, what, [&](std::size_t row) {
    for (std::int32_t x = rows[row].begin; x < rows[row].end; ++x) {
      const AtlasPlace place{rows[row].patch, static_cast<double>(x), static_cast<double>(rows[row].y)};
      work(place, atlas_.texel_of(place));
    }
  });
}

void AtlasBaker::continue_beyond_borders(BakedMap& map) const {
  if (map.shrink > 1) {
    lozenge::continue_beyond_borders(map, atlas_, target_);
    return;
  }
  for_each_texel("", [&](const AtlasPlace& place, std::size_t texel) {
    const AtlasPlace owner = atlas_.first_name(atlas_.inside(place));
    if (owner == place) return;
    const auto at = [&](std::size_t t) { return map.texels.begin() + static_cast<std::ptrdiff_t>(t * map.channels); };
    std::copy_n(at(atlas_.texel_of(owner)), map.channels, at(texel));
  });
}

void AtlasBaker::continue_beyond_tiles(BakedMap& map) const {
  const MapLayout& layout = map.layout;
  const auto channels = static_cast<std::ptrdiff_t>(map.channels);
  const std::ptrdiff_t width = layout.width * channels;
  const std::int32_t step = layout.smallest_tile();
  for (std::int32_t y = 0; y < layout.height; ++y) {
    const auto row = map.texels.begin() + y * width;
    // Tiles fill rows from the left, and the picture from the top.
    std::int32_t end = 0;
    while (end < layout.width && layout.patch_at(end, y) >= 0) end += step;
    if (end == 0) std::copy_n(row - width, width, row);
    for (std::int32_t x = std::max(end, 1); end > 0 && x < layout.width; ++x) {
      std::copy_n(row + (end - 1) * channels, channels, row + x * channels);
    }
  }
}

}  // namespace lozenge
