#include "stages/export/level_sight.h"

#include <algorithm>

#include "formats/base/parallel.h"
#include "formats/patches/source_level.h"

namespace lozenge {

namespace {

/// How far rays go at least, by the diagonal of the bounding box. Twice or half as far makes no difference that one
/// could see, for the nearest point that faces the same way is taken.
constexpr double kLeastCage = 0.01;
/// Or how far by the largest distance between the middle of a triangle and the source: rays slant.
constexpr double kCageMargin = 2;
/// Rays start this far before the surface that they come from, by the diagonal, so that a source in the very same place
/// is met.
constexpr double kTinyShare = 1e-6;

}  // namespace

SeeingTriangle::SeeingTriangle(const ChartedSurface& level, const FramedSurface& framed, std::int32_t number) {
  const ChartedTriangle& t = level.triangles[number];
  for (int c = 0; c < 3; ++c) {
    places_[c] = t.corners[c].place;
    positions_[c] = Vec3d(level.positions[t.corners[c].vertex]);
    vertices_[c] = &framed.vertices[framed.indices[3 * static_cast<std::size_t>(number) + static_cast<std::size_t>(c)]];
  }
}

Vec3d SeeingTriangle::weights(const Vec2d& place) const {
  Vec3d w = weights_in(places_, place);
  for (int c = 0; c < 3; ++c) w[c] = std::max(w[c], 0.0);
  const double sum = w.x + w.y + w.z;
  return sum > 0 ? w / sum : Vec3d(1, 0, 0);
}

LevelSight::LevelSight(const GeometryImage& image, const MapLayout& layout, const ChartedSurface& source,
                       const RayScene& scene)
    : atlas_(image, layout),
      source_(source),
      scene_(scene),
      parts_(parts_of_patches(image.layout.adjacency)),
      diagonal_(diagonal(image.layout.bounds)) {}

std::int32_t LevelSight::most_shrink(std::int32_t given, std::int32_t wish) const {
  const MapLayout& layout = atlas_.layout();
  const std::int32_t tile = layout.smallest_tile();
  const auto fits = [&](std::int32_t shrink) {
    return shrink <= 2 * layout.gutter_of(tile) + 1 && tile % shrink == 0 && layout.width % shrink == 0 &&
           layout.height % shrink == 0;
  };
  std::int32_t shrink = given;
  while (2 * shrink <= wish * given && fits(2 * shrink)) shrink *= 2;
  return shrink;
}

double LevelSight::cage_of(const ChartedSurface& level) const {
  std::vector<double> distances(level.triangles.size());
  for_each_index(distances.size(), true, [&](std::size_t t) {
    Vec3d sum(0, 0, 0);
    for (const ChartedCorner& c : level.triangles[t].corners) sum += Vec3d(level.positions[c.vertex]);
    distances[t] = scene_.nearest(sum / 3).distance;
  });
  const auto most = std::max_element(distances.begin(), distances.end());
  return std::max(kLeastCage * diagonal_, most == distances.end() ? 0 : kCageMargin * *most);
}

/// What a row of a tile's texels looks for the source from: `rays * rays` points each.
struct LevelSight::Row {
  std::vector<std::int32_t> columns;  ///< [texel]
  std::vector<Vec2d> places;          ///< [point] of the patch, shares of its side
  std::vector<OrientedPoint> points;
};

LevelSight::Row LevelSight::row_of(const TriangleTile& tile, const std::vector<SeeingTriangle>& drawn,
                                   std::int32_t patch, std::int32_t y, const Texels& texels) const {
  Row row;
  for (std::int32_t x = 0; x < tile.size(); ++x) {
    if (tile.at(x, y) == TriangleTile::kNone) continue;
    const SeeingTriangle& t = drawn[static_cast<std::size_t>(tile.at(x, y))];
    row.columns.push_back(x);
    for (std::int32_t r = 0; r < texels.rays * texels.rays; ++r) {
      const double first = -0.5 * (texels.rays - 1);
      const Vec2d off =
          Vec2d(r % texels.rays + first, r / texels.rays + first) * texels.shrink / static_cast<double>(texels.rays);
      row.places.push_back((tile.middle(x, y) + off) / atlas_.last(patch));
      const Vec3d w = t.weights(row.places.back());
      row.points.push_back({t.position(w), t.normal(w).normalized()});
    }
  }
  return row;
}

/// Of each point of a row. Where no ray meets the source, the very same place.
std::vector<SeenPlace> LevelSight::places_of(const Row& row, double cage, std::int32_t patch) const {
  std::vector<RayHit> hits(row.points.size());
  facing_hits_through(
      scene_, row.points, cage, kTinyShare * diagonal_,
      [&](std::size_t, TriangleId t) { return parts_[source_.triangles[t].patch] == parts_[patch]; }, hits);
  std::vector<SeenPlace> seen(hits.size());
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (!hits[k].exists()) {
      seen[k] = {patch, row.places[k]};
      continue;
    }
    const ChartedTriangle& t = source_.triangles[hits[k].triangle];
    seen[k] = {t.patch, Vec2d(0, 0)};
    for (int c = 0; c < 3; ++c) {
      seen[k].place += t.corners[c].place * hits[k].weights[c];
      seen[k].normal += Vec3d(t.corners[c].carried) * hits[k].weights[c];
    }
    seen[k].normal.normalize();
  }
  return seen;
}

void LevelSight::look(const ChartedSurface& level, const FramedSurface& framed, const Texels& texels,
                      const std::function<void(const SeenTexel&)>& visit) const {
  const auto triangles = triangles_by_patch(level, atlas_.patches());
  const double cage = cage_of(level);
  const auto rays = static_cast<std::size_t>(texels.rays * texels.rays);
  for_each_index(triangles.size(), true, [&](std::size_t p) {
    const auto patch = static_cast<std::int32_t>(p);
    const MapTile& tile = atlas_.tile(patch);
    TriangleTile drawn(tile, texels.shrink);
    std::vector<SeeingTriangle> seeing;
    for (const std::int32_t t : triangles[p]) {
      drawn.draw(level.triangles[t], static_cast<std::int32_t>(seeing.size()));
      seeing.emplace_back(level, framed, t);
    }
    drawn.spread();
    for (std::int32_t y = 0; y < drawn.size(); ++y) {
      const Row row = row_of(drawn, seeing, patch, y, texels);
      const std::vector<SeenPlace> places = places_of(row, cage, patch);
      for (std::size_t i = 0; i < row.columns.size(); ++i) {
        const std::int32_t x = row.columns[i];
        const SeeingTriangle& t = seeing[static_cast<std::size_t>(drawn.at(x, y))];
        const std::size_t texel = atlas_.layout().texel_of(tile, x, y, texels.shrink);
        visit({texel, t.frame(t.weights(drawn.middle(x, y) / atlas_.last(patch))),
               std::span(places).subspan(rays * i, rays)});
      }
    }
  });
}

}  // namespace lozenge
