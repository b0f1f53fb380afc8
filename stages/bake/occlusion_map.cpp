#include "stages/bake/occlusion_map.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "stages/bake/modelled_bodies.h"
#include "stages/bake/occlusion.h"

namespace lozenge {

namespace {

/// See BakeOptions::occlusion_size. No texel lies across two tiles, and bilinear filtering inside of a tile reads none
/// of another.
std::int32_t shrink_of(const BakeOptions& options, const MapLayout& layout) {
  const std::int32_t most = std::max(2 * layout.gutter_of(layout.smallest_tile()), 1);
  std::int32_t shrink = std::clamp(layout.width / options.occlusion_size, 1, most);
  while (layout.width % shrink != 0 || layout.smallest_tile() % shrink != 0) --shrink;
  return shrink;
}

/// \param apart  null: in the rest pose
float openness_at(const AtlasBaker& baker, const ModelledBodies* apart, const SourcePoint& source, double farthest,
                  std::uint64_t seed, BakeTally& tally) {
  const Projector& projector = baker.projector();
  if (apart != nullptr) {
    const double unit = apart->unit_of(source.triangle);
    return openness(apart->scene_of(source.triangle), apart->at(source),
                    {baker.options().occlusion_rays, 10 * projector.tiny() * unit, farthest * unit}, seed, tally.rays);
  }
  const OcclusionPoint point{Vec3d(position_at(projector.mesh(), source)), projector.face_normal(source.triangle),
                             Vec3d(baker.normals().at(source.triangle, source.weights))};
  return openness(projector.scene(), point, {baker.options().occlusion_rays, 10 * projector.tiny(), farthest}, seed,
                  tally.rays);
}

}  // namespace

BakedMap bake_occlusion(AtlasBaker& baker) {
  constexpr float kDark = 0.1F;
  BakedMap map = baker.neutral(MapKind::kOcclusion, shrink_of(baker.options(), baker.atlas().layout()));
  const Atlas& atlas = baker.atlas();
  const double half = 0.5 * map.shrink - 0.5;
  const double farthest = baker.options().occlusion_distance.value_or(
      kOcclusionReach * diagonal(bounds_of(baker.projector().mesh().positions)));
  std::optional<ModelledBodies> apart;
  if (baker.options().occlusion_pose == OcclusionPose::kModelling) apart.emplace(baker.projector().mesh());
  std::vector<std::int64_t> dark(static_cast<std::size_t>(map.height()), 0);
  std::vector<std::int64_t> baked(dark.size(), 0);
  baker.bake_rows(dark.size(), "baking occlusion", [&](std::size_t y, BakeTally& tally) {
    std::vector<AtlasPlace> places;
    std::vector<std::size_t> texels;  // [place]
    for (std::int32_t x = 0; x < map.width(); ++x) {
      const AtlasPlace place =
          atlas.place_at(static_cast<double>(x) * map.shrink + half, static_cast<double>(y) * map.shrink + half);
      if (place.patch < 0) continue;
      if (atlas.inside(place) != place) {  // in the gutter, or beyond the surface's boundary
        tally.unused += atlas.within_patch(place);
        continue;
      }
      places.push_back(place);
      texels.push_back(y * map.width() + x);
    }
    const std::vector<SourcePoint> sources = baker.sources_of(places, tally);
    for (std::size_t i = 0; i < places.size(); ++i) {
      float& open = map.texels[texels[i]];
      open = openness_at(baker, apart ? &*apart : nullptr, sources[i], farthest, texels[i], tally);
      if (open < kDark) ++dark[y];
    }
    tally.texels += static_cast<std::int64_t>(places.size());
    baked[y] = tally.texels;
  });
  baker.continue_beyond_borders(map);
  const auto sum = [](const std::vector<std::int64_t>& rows) {
    return static_cast<double>(std::accumulate(rows.begin(), rows.end(), std::int64_t{0}));
  };
  if (sum(baked) > 0) baker.set_dark_share(sum(dark) / sum(baked));
  return map;
}

}  // namespace lozenge
