// The triangles of the source level are drawn into their patches' tiles, so that each texel knows the one whose frame
// it is seen in; they reach into gutters where cuts close to a border were left out. Texels that none covers aren't
// seen but by filters: they have the triangle of a texel beside them.
#include "stages/bake/source_normal_map.h"

#include <algorithm>
#include <string_view>

#include "formats/base/parallel.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/source_level.h"
#include "formats/patches/triangle_tile.h"

namespace lozenge {

namespace {

/// In object space.
struct SourceDirections {
  BakedMap told;     ///< by textures
  BakedMap shading;  ///< normals without those of textures
};

/// \param direction_at  (footprint) in the space of the asset
template <typename DirectionAt>
SourceDirections bake_in_object_space(AtlasBaker& baker, std::string_view what, const DirectionAt& direction_at) {
  SourceDirections made{baker.neutral(MapKind::kObjectNormal), baker.neutral(MapKind::kObjectNormal)};
  baker.bake_inner_texels(what, [&](const AtlasPlace& place, std::size_t texel) {
    const SourceFootprint footprint = baker.footprint(place);
    store(made.told, texel, Vec3f(direction_at(footprint)));
    store(made.shading, texel, baker.normals().at(footprint.at.triangle, footprint.at.weights));
  });
  baker.continue_beyond_borders(made.told);
  baker.continue_beyond_borders(made.shading);
  return made;
}

/// The frame with the normal of the texel's own side of a hard edge, whichever side the renderer's is of: so that what
/// a filter mixes there is how normals differ from the shading, not the edge.
ShadingFrame with_normal(ShadingFrame frame, const Vec3d& normal) {
  const Vec3d tangent = frame.tangent - normal * normal.dot(frame.tangent);
  constexpr double kAlong = 1e-6;
  if (!(normal.length() > 0) || !(tangent.length() > kAlong)) return frame;
  frame.normal = normal;
  frame.tangent = tangent.normalized();
  frame.bitangent = normal.cross(frame.tangent) * static_cast<double>(kBitangentSign);
  return frame;
}

/// What the atlas is of.
struct Surface {
  const SourceMesh& mesh;
  const Parameterization& map;
  const GeometryImage& image;
};

/// \param told_in  (frame, direction) what the map says of a direction there
template <typename ToldIn>
BakedMap in_own_frames(AtlasBaker& baker, const Surface& of, MapKind kind, const SourceDirections& source,
                       const ToldIn& told_in) {
  const Atlas& atlas = baker.atlas();
  const ChartedSurface surface = source_level(of.mesh, of.map, of.image.layout, atlas.layout());
  const FramedSurface framed = framed_surface(surface, atlas.layout());
  const auto triangles = triangles_by_patch(surface, atlas.patches());
  BakedMap told = baker.neutral(kind);
  for_each_index(triangles.size(), true, [&](std::size_t p) {
    const auto patch = static_cast<std::int32_t>(p);
    const MapTile& tile = atlas.tile(patch);
    TriangleTile seen(tile);
    for (const std::int32_t t : triangles[p]) seen.draw(surface.triangles[t], t);
    seen.spread();
    for (std::int32_t y = 0; y < seen.size(); ++y) {
      for (std::int32_t x = 0; x < seen.size(); ++x) {
        const std::int32_t t = seen.at(x, y);
        if (t == TriangleTile::kNone) continue;
        const Vec2d middle = seen.middle(x, y);
        const AtlasPlace place{patch, middle.x, middle.y};
        const std::size_t texel = atlas.texel_of(place);
        const ShadingFrame frame = with_normal(frame_at(framed, surface.triangles[t], t, atlas.share_of(place)),
                                               Vec3d(load(source.shading, texel)));
        store(told, texel, Vec3f(told_in(frame, Vec3d(load(source.told, texel)))));
      }
    }
  });
  return told;
}

Vec3d normal_in(const ShadingFrame& frame, const Vec3d& normal) { return frame.to_texel(normal); }

/// x and y of the direction, halved and shifted, and how long it was.
Vec3d brushed_in(const ShadingFrame& frame, const Vec3d& direction) {
  const Vec2d along(direction.dot(frame.tangent), direction.dot(frame.bitangent));
  const double length = along.length();
  if (!(length > 0)) return {1, 0.5, 0};
  return {0.5 + 0.5 * along.x / length, 0.5 + 0.5 * along.y / length, std::min(direction.length(), 1.0)};
}

}  // namespace

BakedMap bake_source_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                             const GeometryImage& image) {
  const auto normal = [&](const SourceFootprint& footprint) { return baker.look().normal(footprint); };
  return in_own_frames(baker, {mesh, map, image}, MapKind::kSourceNormal,
                       bake_in_object_space(baker, "baking the source's normals", normal), normal_in);
}

BakedMap bake_clearcoat_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                                const GeometryImage& image) {
  const auto normal = [&](const SourceFootprint& footprint) { return baker.look().clearcoat_normal(footprint); };
  return in_own_frames(baker, {mesh, map, image}, MapKind::kClearcoatNormal,
                       bake_in_object_space(baker, "baking normals of clearcoats", normal), normal_in);
}

BakedMap bake_anisotropy(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                         const GeometryImage& image) {
  const auto direction = [&](const SourceFootprint& footprint) { return baker.look().anisotropy(footprint); };
  return in_own_frames(baker, {mesh, map, image}, MapKind::kAnisotropy,
                       bake_in_object_space(baker, "baking anisotropy", direction), brushed_in);
}

}  // namespace lozenge
