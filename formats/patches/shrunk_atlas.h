// Gutters of maps whose texels are each as wide as several of the atlas's: they lie elsewhere in a gutter than beyond
// the border, so no texel of the neighbour is theirs. What they show is what a look-up in the neighbour gives at their
// place.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/patches/atlas.h"
#include "formats/patches/target_surface.h"

namespace lozenge {

/// A bilinear look-up in a map: indices of texels, and how much each counts; one may be there twice.
struct TexelMix {
  std::int32_t patch = -1;
  std::array<std::size_t, 4> texels{};
  std::array<AtlasPlace, 4> places{};  ///< of their middles
  std::array<double, 4> weights{};     ///< which add up to 1
};

class ShrunkAtlas {
 public:
  /// Keeps a reference to `atlas`. \param shrink  texels of the atlas that one of the map's is wide
  ShrunkAtlas(const Atlas& atlas, std::int32_t shrink);

  /// The middle of texel (x, y) of the map, in texels of the atlas; patch -1 where there is none.
  AtlasPlace place_of(std::int32_t x, std::int32_t y) const;

  /// Whether the patch has that place: then the texel is its own.
  bool is_own(const AtlasPlace& place) const { return atlas_.inside(place) == place; }

  /// What another texel shows: of those that the patch has beyond the border, or before the surface's boundary.
  /// \pre  !is_own(place)
  TexelMix shown_at(const AtlasPlace& place) const;

 private:
  const Atlas& atlas_;
  std::int32_t shrink_;
};

/// Whether a map's numbers are told in the frames of the source's own triangles, which only the source knows: then
/// nothing is to be said of texels of different patches.
bool is_in_source_frames(MapKind kind);

/// Gives all texels that aren't their patches' own what they show: numbers are mixed, directions too, in the frames
/// that they are told in, if those are of the level of detail. \pre  all others are there,
/// !is_in_source_frames(map.kind)
void continue_beyond_borders(BakedMap& map, const Atlas& atlas, const TargetSurface& surface);

/// What a texel of a map of directions means: of those of the level's frames, in object space.
Vec3d object_direction(const BakedMap& map, std::size_t texel, const Atlas& atlas, const AtlasPlace& place,
                       const TargetSurface& surface);

}  // namespace lozenge
