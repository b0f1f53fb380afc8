#include "stages/bake/normal_maps.h"

namespace lozenge {

namespace {

Vec3f normal_at(const AtlasBaker& baker, const SourcePoint& source, const AtlasPlace& place) {
  if (!baker.look().has_normal_texture(source.triangle)) return baker.normals().at(source.triangle, source.weights);
  return Vec3f(baker.look().normal(baker.footprint_at(source, place)));
}

}  // namespace

BakedMap bake_object_normals(AtlasBaker& baker) {
  BakedMap map = baker.neutral(MapKind::kObjectNormal);
  baker.bake_seen_texels("baking normals", [&](const AtlasPlace& place, std::size_t texel, const SourcePoint& source) {
    store(map, texel, normal_at(baker, source, place));
  });
  baker.continue_beyond_borders(map);
  return map;
}

BakedMap bake_tangent_normals(const AtlasBaker& baker, const BakedMap& object_normals) {
  BakedMap map = baker.neutral(MapKind::kTangentNormal);
  const Atlas& atlas = baker.atlas();
  baker.for_each_texel("turning normals into tangent space", [&](const AtlasPlace& place, std::size_t texel) {
    const Vec2d at = atlas.nearest_of_own_patch(place) / atlas.last(place.patch);
    const ShadingFrame frame = baker.target().at(place.patch, at.x, at.y).frame;
    store(map, texel, Vec3f(frame.to_texel(Vec3d(load(object_normals, texel)))));
  });
  return map;
}

}  // namespace lozenge
