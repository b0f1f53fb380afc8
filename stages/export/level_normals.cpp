// Normals go from the frames of the image's level to the asset's space, once; then what each texel of a level sees is
// taken from there into the level's frame. So whatever went into the map goes into those of all levels, the source's
// own normal textures too.
#include "stages/export/level_normals.h"

#include "formats/base/parallel.h"
#include "formats/patches/target_surface.h"
#include "stages/export/texel_lookup.h"

namespace lozenge {

namespace {

/// Cosine: texels whose normals are further than this from the source's own, without its textures, are of the other
/// side of a crease. Normal textures hardly ever lean so far.
constexpr double kSameSide = 0.7;

}  // namespace

LevelNormals::LevelNormals(const GeometryImage& image, const BakedMap& map, const LevelSight& sight)
    : map_(map), atlas_(sight.atlas()), object_(map.texels.size() / 3, Vec3f(0, 0, 1)) {
  const TargetSurface baked_for(image, map.level, map.layout);
  for_each_index(static_cast<std::size_t>(atlas_.patches()), true, [&](std::size_t p) {
    const auto patch = static_cast<std::int32_t>(p);
    const TriangleTile tile(atlas_.tile(patch), map.shrink);
    for (std::int32_t y = 0; y < tile.size(); ++y) {
      for (std::int32_t x = 0; x < tile.size(); ++x) {
        const Vec2d middle = tile.middle(x, y);
        const Vec2d at = atlas_.nearest_of_own_patch({patch, middle.x, middle.y}) / atlas_.last(patch);
        const std::size_t texel = map.layout.texel_of(atlas_.tile(patch), x, y, map.shrink);
        object_[texel] = Vec3f(baked_for.at(patch, at.x, at.y).frame.to_object(Vec3d(load(map, texel))));
      }
    }
  });
}

Vec3d LevelNormals::of_source(std::int32_t patch, const Vec2d& place) const {
  return between_texels(map_, atlas_, patch, place, [&](std::size_t texel) { return Vec3d(object_[texel]); });
}

Vec3d LevelNormals::shown_by(const BakedMap& map, const ChartedSurface& level, const FramedSurface& framed,
                             TriangleId triangle, const Vec3d& weights) const {
  const ChartedTriangle& charted = level.triangles[triangle];
  Vec2d place(0, 0);
  for (int c = 0; c < 3; ++c) place += charted.corners[c].place * weights[c];
  const Vec3d texel =
      between_texels(map, atlas_, charted.patch, place, [&](std::size_t i) { return Vec3d(load(map, i)); });
  return SeeingTriangle(level, framed, triangle).frame(weights).to_object(texel);
}

/// What the source's map says of a place that is seen, without the texels that show another side of a crease.
Vec3d LevelNormals::normal_at(const SeenPlace& seen) const {
  const Vec3d& own = seen.normal;
  if (!(own.length2() > 0)) return of_source(seen.patch, seen.place);
  const Vec3d found = between_texels(map_, atlas_, seen.patch, seen.place, [&](std::size_t texel) {
    const Vec3d normal(object_[texel]);
    return normal.dot(own) > kSameSide ? normal : Vec3d(0, 0, 0);
  });
  return found.length2() > 0 ? found.normalized() : own;
}

void LevelNormals::paint(BakedMap& made, const SeenTexel& seen) const {
  Vec3d sum(0, 0, 0);
  for (const SeenPlace& place : seen.places) sum += normal_at(place);
  store(made, seen.texel, Vec3f(seen.frame.to_texel(sum)));
}

}  // namespace lozenge
