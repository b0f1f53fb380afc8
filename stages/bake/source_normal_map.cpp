// The triangles of the source level are drawn into their patches' tiles, so that each texel knows the one whose frame
// it is seen in; they reach into gutters where cuts close to a border were left out. Texels that none covers aren't
// seen but by filters: they have the triangle of a texel beside them.
#include "stages/bake/source_normal_map.h"

#include "formats/base/parallel.h"
#include "formats/patches/framed_surface.h"
#include "formats/patches/source_level.h"
#include "formats/patches/triangle_tile.h"

namespace lozenge {

namespace {

/// In object space.
struct SourceNormals {
  BakedMap textured;
  BakedMap shading;  ///< without those of textures
};

SourceNormals bake_in_object_space(AtlasBaker& baker) {
  SourceNormals made{baker.neutral(MapKind::kObjectNormal), baker.neutral(MapKind::kObjectNormal)};
  baker.bake_inner_texels("baking the source's normals", [&](const AtlasPlace& place, std::size_t texel) {
    const SourceFootprint footprint = baker.footprint(place);
    store(made.textured, texel, Vec3f(baker.look().normal(footprint)));
    store(made.shading, texel, baker.normals().at(footprint.at.triangle, footprint.at.weights));
  });
  baker.continue_beyond_borders(made.textured);
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

}  // namespace

BakedMap bake_source_normals(AtlasBaker& baker, const SourceMesh& mesh, const Parameterization& map,
                             const GeometryImage& image) {
  const SourceNormals source = bake_in_object_space(baker);
  const Atlas& atlas = baker.atlas();
  const ChartedSurface surface = source_level(mesh, map, image.layout, atlas.layout());
  const FramedSurface framed = framed_surface(surface, atlas.layout());
  const auto triangles = triangles_by_patch(surface, atlas.patches());
  BakedMap normals = baker.neutral(MapKind::kSourceNormal);
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
        store(normals, texel, Vec3f(frame.to_texel(Vec3d(load(source.textured, texel)))));
      }
    }
  });
  return normals;
}

}  // namespace lozenge
