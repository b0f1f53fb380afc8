#include "stages/export/level_maps.h"

#include <algorithm>
#include <map>
#include <utility>

#include "formats/patches/shrunk_atlas.h"
#include "formats/patches/shrunk_map.h"
#include "stages/export/texel_lookup.h"

namespace lozenge {

namespace {

/// Rays a side of a texel that is wider than those of the given map.
constexpr std::int32_t kRaysOfWideTexels = 2;

/// Whether its numbers mean the same wherever on a surface they stand.
bool holds_anywhere(MapKind kind) { return traits_of(kind).frames == Frames::kNone && !is_in_source_frames(kind); }

Vec4d numbers_at(const BakedMap& map, std::size_t texel) {
  Vec4d numbers(0, 0, 0, 0);
  const auto channels = static_cast<std::size_t>(map.channels);
  for (std::size_t c = 0; c < channels; ++c) numbers[static_cast<int>(c)] = map.texels[channels * texel + c];
  return numbers;
}

/// The mean of what is seen goes into `made`.
void paint_numbers(BakedMap& made, const BakedMap& given, const Atlas& atlas, const SeenTexel& seen) {
  Vec4d sum(0, 0, 0, 0);
  for (const SeenPlace& at : seen.places) {
    sum +=
        between_texels(given, atlas, at.patch, at.place, [&](std::size_t texel) { return numbers_at(given, texel); });
  }
  sum /= static_cast<double>(seen.places.size());
  const auto channels = static_cast<std::size_t>(made.channels);
  for (std::size_t c = 0; c < channels; ++c) {
    made.texels[channels * seen.texel + c] = static_cast<float>(sum[static_cast<int>(c)] + 0.0);
  }
}

/// A map on its way from the source's to a level's.
struct Painted {
  const BakedMap* given = nullptr;
  BakedMap made;
  /// The given one at about the resolution of the rays; nothing where it is that.
  std::optional<BakedMap> smoothed = {};
};

}  // namespace

LevelMaps::LevelMaps(const GeometryImage& image, const MapLayout& layout, const std::vector<const BakedMap*>& maps,
                     const BakedMap* normals, const ChartedSurface& source, const RayScene& scene)
    : sight_(image, layout, source, scene) {
  if (normals != nullptr) normals_.emplace(image, *normals, sight_);
  for (const BakedMap* map : maps) {
    if (holds_anywhere(map->kind)) numbers_.push_back(map);
  }
}

std::vector<BakedMap> LevelMaps::seen_from(const ChartedSurface& level, const FramedSurface& framed,
                                           std::int32_t wish) const {
  std::vector<const BakedMap*> given = numbers_;
  if (normals_) given.insert(given.begin(), &normals_->map());
  // Maps of one resolution are seen by the same rays.
  std::map<std::int32_t, std::vector<Painted>> by_shrink;
  for (const BakedMap* map : given) {
    const std::int32_t shrink = sight_.most_shrink(map->shrink, wish);
    const std::int32_t times = shrink / map->shrink;
    // Tiles that the level shows nothing of, and what is beyond all tiles, still go into coarse mips.
    Painted painted{map, holds_anywhere(map->kind)
                             ? shrunk(*map, times)
                             : neutral_map(map->kind, map->layout, map->level, shrink, map->channels)};
    const std::int32_t finer = times / kRaysOfWideTexels;
    if (finer > 1 && holds_anywhere(map->kind)) painted.smoothed = shrunk(*map, finer);
    by_shrink[shrink].push_back(std::move(painted));
  }
  std::vector<BakedMap> made;
  for (auto& [shrink, maps] : by_shrink) {
    const bool are_wide =
        std::any_of(maps.begin(), maps.end(), [&](const Painted& map) { return shrink > map.given->shrink; });
    sight_.look(level, framed, {shrink, are_wide ? kRaysOfWideTexels : 1}, [&](const SeenTexel& seen) {
      for (Painted& map : maps) {
        if (map.made.kind == MapKind::kTangentNormal) normals_->paint(map.made, seen);
        else paint_numbers(map.made, map.smoothed ? *map.smoothed : *map.given, sight_.atlas(), seen);
      }
    });
    for (Painted& map : maps) made.push_back(std::move(map.made));
  }
  std::sort(made.begin(), made.end(), [](const BakedMap& a, const BakedMap& b) { return a.kind < b.kind; });
  return made;
}

}  // namespace lozenge
