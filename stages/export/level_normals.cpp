// Normals go from the frames of the image's level to the asset's space, once; then each texel of a level looks along
// its normal for the source, whose place in the atlas says where the map has that point, and takes the normal there
// into the level's frame. So whatever went into the map goes into those of all levels, the source's own normal textures
// too.
#include "stages/export/level_normals.h"

#include <algorithm>
#include <array>

#include "formats/base/parallel.h"
#include "formats/patches/source_level.h"
#include "formats/patches/target_surface.h"

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
/// Cosine: texels whose normals are further than this from the source's own, without its textures, are of the other
/// side of a crease. Normal textures hardly ever lean so far.
constexpr double kSameSide = 0.7;

/// Index of texel (x, y) of a tile, counted from its first, in a map.
std::size_t texel_of(const BakedMap& map, const MapTile& tile, std::int32_t x, std::int32_t y) {
  return static_cast<std::size_t>(tile.y / map.shrink + y) * map.width() +
         static_cast<std::size_t>(tile.x / map.shrink + x);
}

/// What bilinear filtering shows of a map at a place of a patch, within the patch's tile. \param value  of a texel's
/// index
template <typename Value>
Vec3d between_texels(const BakedMap& map, const Atlas& atlas, std::int32_t patch, const Vec2d& place,
                     const Value& value) {
  const MapTile& tile = atlas.tile(patch);
  const std::int32_t texels = tile.size / map.shrink;
  const double half = 0.5 * map.shrink - 0.5;
  const Vec2d at =
      (place * atlas.last(patch) + Vec2d(tile.gutter - half, tile.gutter - half)) / static_cast<double>(map.shrink);
  const double x = std::clamp(at.x, 0.0, static_cast<double>(texels - 1));
  const double y = std::clamp(at.y, 0.0, static_cast<double>(texels - 1));
  const auto i = std::clamp(static_cast<std::int32_t>(x), 0, std::max(texels - 2, 0));
  const auto j = std::clamp(static_cast<std::int32_t>(y), 0, std::max(texels - 2, 0));
  const auto texel = [&](std::int32_t dx, std::int32_t dy) {
    return value(texel_of(map, tile, std::min(i + dx, texels - 1), std::min(j + dy, texels - 1)));
  };
  const double u = x - i;
  const double v = y - j;
  return (texel(0, 0) * (1 - u) + texel(1, 0) * u) * (1 - v) + (texel(0, 1) * (1 - u) + texel(1, 1) * u) * v;
}

}  // namespace

/// One triangle of a level as its texels need it.
class LevelNormals::LevelTriangle {
 public:
  LevelTriangle(const ChartedSurface& level, const FramedSurface& framed, std::int32_t number) {
    const ChartedTriangle& t = level.triangles[number];
    for (int c = 0; c < 3; ++c) {
      places_[c] = t.corners[c].place;
      positions_[c] = Vec3d(level.positions[t.corners[c].vertex]);
      vertices_[c] =
          &framed.vertices[framed.indices[3 * static_cast<std::size_t>(number) + static_cast<std::size_t>(c)]];
    }
  }

  /// Of a place, or of one on the triangle beside it.
  Vec3d weights(const Vec2d& place) const {
    Vec3d w = weights_in(places_, place);
    for (int c = 0; c < 3; ++c) w[c] = std::max(w[c], 0.0);
    const double sum = w.x + w.y + w.z;
    return sum > 0 ? w / sum : Vec3d(1, 0, 0);
  }
  Vec3d position(const Vec3d& w) const { return positions_[0] * w.x + positions_[1] * w.y + positions_[2] * w.z; }
  /// Of any length.
  Vec3d normal(const Vec3d& w) const {
    return Vec3d(vertices_[0]->normal) * w.x + Vec3d(vertices_[1]->normal) * w.y + Vec3d(vertices_[2]->normal) * w.z;
  }
  ShadingFrame frame(const Vec3d& w) const { return shading_frame(vertices_, w); }

 private:
  std::array<Vec2d, 3> places_;
  std::array<Vec3d, 3> positions_;
  std::array<const FrameVertex*, 3> vertices_{};
};

LevelNormals::LevelNormals(const GeometryImage& image, const BakedMap& map, const ChartedSurface& source,
                           const RayScene& scene)
    : atlas_(image, map.layout),
      map_(map),
      source_(source),
      scene_(scene),
      parts_(parts_of_patches(image.layout.adjacency)),
      diagonal_(diagonal(image.layout.bounds)),
      object_(map.texels.size() / 3, Vec3f(0, 0, 1)) {
  const TargetSurface baked_for(image, map.level, map.layout);
  for_each_index(static_cast<std::size_t>(atlas_.patches()), true, [&](std::size_t p) {
    const auto patch = static_cast<std::int32_t>(p);
    const TriangleTile tile(atlas_.tile(patch), map.shrink);
    for (std::int32_t y = 0; y < tile.size(); ++y) {
      for (std::int32_t x = 0; x < tile.size(); ++x) {
        const Vec2d middle = tile.middle(x, y);
        const Vec2d at = atlas_.nearest_of_own_patch({patch, middle.x, middle.y}) / atlas_.last(patch);
        const std::size_t texel = texel_of(map, atlas_.tile(patch), x, y);
        const Vec3d normal(map.texels[3 * texel], map.texels[3 * texel + 1], map.texels[3 * texel + 2]);
        object_[texel] = Vec3f(baked_for.at(patch, at.x, at.y).frame.to_object(normal));
      }
    }
  });
}

std::int32_t LevelNormals::most_shrink(std::int32_t wish) const {
  const MapLayout& layout = atlas_.layout();
  const std::int32_t tile = layout.smallest_tile();
  const auto fits = [&](std::int32_t shrink) {
    return shrink <= layout.gutter_of(tile) && tile % shrink == 0 && layout.width % shrink == 0 &&
           layout.height % shrink == 0;
  };
  std::int32_t shrink = map_.shrink;
  while (2 * shrink <= wish * map_.shrink && fits(2 * shrink)) shrink *= 2;
  return shrink;
}

/// Between the texels of a tile; of any length.
Vec3d LevelNormals::normal_at(std::int32_t patch, const Vec2d& place) const {
  return between_texels(map_, atlas_, patch, place, [&](std::size_t texel) { return Vec3d(object_[texel]); });
}

Vec3d LevelNormals::shown_by(const BakedMap& map, const ChartedSurface& level, const FramedSurface& framed,
                             TriangleId triangle, const Vec3d& weights) const {
  const LevelTriangle t(level, framed, triangle);
  const ChartedTriangle& charted = level.triangles[triangle];
  Vec2d place(0, 0);
  for (int c = 0; c < 3; ++c) place += charted.corners[c].place * weights[c];
  const Vec3d texel = between_texels(map, atlas_, charted.patch, place, [&](std::size_t i) {
    return Vec3d(map.texels[3 * i], map.texels[3 * i + 1], map.texels[3 * i + 2]);
  });
  return t.frame(weights).to_object(texel);
}

double LevelNormals::cage_of(const ChartedSurface& level) const {
  std::vector<double> distances(level.triangles.size());
  for_each_index(distances.size(), true, [&](std::size_t t) {
    Vec3d sum(0, 0, 0);
    for (const ChartedCorner& c : level.triangles[t].corners) sum += Vec3d(level.positions[c.vertex]);
    distances[t] = scene_.nearest(sum / 3).distance;
  });
  const auto most = std::max_element(distances.begin(), distances.end());
  return std::max(kLeastCage * diagonal_, most == distances.end() ? 0 : kCageMargin * *most);
}

/// What the source's map says of a place that a ray met there, without the texels that show another side of a crease.
Vec3d LevelNormals::normal_at(const RayHit& hit) const {
  const ChartedTriangle& t = source_.triangles[hit.triangle];
  Vec2d at(0, 0);
  Vec3d own(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    at += t.corners[k].place * hit.weights[k];
    own += Vec3d(t.corners[k].carried) * hit.weights[k];
  }
  own.normalize();
  if (!(own.length2() > 0)) return normal_at(t.patch, at);
  const Vec3d seen = between_texels(map_, atlas_, t.patch, at, [&](std::size_t texel) {
    const Vec3d normal(object_[texel]);
    return normal.dot(own) > kSameSide ? normal : Vec3d(0, 0, 0);
  });
  return seen.length2() > 0 ? seen.normalized() : own;
}

/// What a row of a tile's texels looks for the source from: `rays * rays` points each.
struct LevelNormals::Row {
  std::vector<std::int32_t> columns;  ///< [texel]
  std::vector<Vec2d> places;          ///< [point] of the patch, shares of its side
  std::vector<OrientedPoint> points;
};

LevelNormals::Row LevelNormals::row_of(const TriangleTile& tile, const std::vector<LevelTriangle>& drawn,
                                       std::int32_t y, const Texels& texels) const {
  Row row;
  for (std::int32_t x = 0; x < tile.size(); ++x) {
    if (tile.at(x, y) == TriangleTile::kNone) continue;
    const LevelTriangle& t = drawn[static_cast<std::size_t>(tile.at(x, y))];
    row.columns.push_back(x);
    for (std::int32_t r = 0; r < texels.rays * texels.rays; ++r) {
      const double first = -0.5 * (texels.rays - 1);
      const Vec2d off =
          Vec2d(r % texels.rays + first, r / texels.rays + first) * texels.shrink / static_cast<double>(texels.rays);
      row.places.push_back((tile.middle(x, y) + off) / atlas_.last(texels.patch));
      const Vec3d w = t.weights(row.places.back());
      row.points.push_back({t.position(w), t.normal(w).normalized()});
    }
  }
  return row;
}

/// Of each texel of a row, of any length. Where no ray meets the source, what the map says at the very same place.
std::vector<Vec3d> LevelNormals::normals_of(const Row& row, double cage, std::int32_t patch) const {
  std::vector<RayHit> hits(row.points.size());
  facing_hits_through(
      scene_, row.points, cage, kTinyShare * diagonal_,
      [&](std::size_t, TriangleId t) { return parts_[source_.triangles[t].patch] == parts_[patch]; }, hits);
  std::vector<Vec3d> sums(row.columns.size(), Vec3d(0, 0, 0));
  for (std::size_t k = 0; k < hits.size(); ++k) {
    sums[k * sums.size() / hits.size()] += hits[k].exists() ? normal_at(hits[k]) : normal_at(patch, row.places[k]);
  }
  return sums;
}

BakedMap LevelNormals::seen_from(const ChartedSurface& level, const FramedSurface& framed, std::int32_t shrink) const {
  BakedMap made = neutral_map(MapKind::kTangentNormal, map_.layout, map_.level, shrink);
  const auto triangles = triangles_by_patch(level, atlas_.patches());
  const double cage = cage_of(level);
  for_each_index(triangles.size(), true, [&](std::size_t p) {
    const Texels texels{static_cast<std::int32_t>(p), shrink, shrink > map_.shrink ? 2 : 1};
    const MapTile& tile = atlas_.tile(texels.patch);
    TriangleTile seen(tile, shrink);
    std::vector<LevelTriangle> drawn;
    for (const std::int32_t t : triangles[p]) {
      seen.draw(level.triangles[t], static_cast<std::int32_t>(drawn.size()));
      drawn.emplace_back(level, framed, t);
    }
    seen.spread();
    for (std::int32_t y = 0; y < seen.size(); ++y) {
      const Row row = row_of(seen, drawn, y, texels);
      const std::vector<Vec3d> normals = normals_of(row, cage, texels.patch);
      for (std::size_t i = 0; i < normals.size(); ++i) {
        const std::int32_t x = row.columns[i];
        const LevelTriangle& t = drawn[static_cast<std::size_t>(seen.at(x, y))];
        const Vec3d w = t.weights(seen.middle(x, y) / atlas_.last(texels.patch));
        store(made, texel_of(made, tile, x, y), Vec3f(t.frame(w).to_texel(normals[i])));
      }
    }
  });
  return made;
}

}  // namespace lozenge
