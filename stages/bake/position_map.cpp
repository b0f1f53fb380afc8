#include "stages/bake/position_map.h"

namespace lozenge {

BakedMap bake_positions(AtlasBaker& baker) {
  BakedMap map = baker.neutral(MapKind::kPosition);
  baker.bake_inner_texels("baking positions", [&](const AtlasPlace& place, std::size_t texel) {
    store(map, texel, position_at(baker.projector().mesh(), baker.correspondence(place)));
  });
  baker.continue_beyond_borders(map);
  return map;
}

}  // namespace lozenge
