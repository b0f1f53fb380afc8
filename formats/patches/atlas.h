// Which place of which patch every texel of the atlas shows, in the gutters and on shared borders too.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"

namespace lozenge {

/// A place of a patch in steps of texels: (0, 0) is (u, v) = (0, 0), (last, last) is (1, 1), where `last` is the
/// patch's. Whole numbers are centres of inner texels; outside of 0..last the place lies beyond the patch's border.
struct AtlasPlace {
  std::int32_t patch = -1;
  double x = 0;
  double y = 0;
  friend bool operator==(const AtlasPlace&, const AtlasPlace&) = default;
};

class Atlas {
 public:
  /// Keeps a reference to `image`.
  Atlas(const GeometryImage& image, const MapLayout& layout);

  const MapLayout& layout() const { return layout_; }
  std::int32_t patches() const { return image_.size(); }
  const MapTile& tile(std::int32_t patch) const { return tiles_[patch]; }
  double last(std::int32_t patch) const { return tiles_[patch].inner() - 1; }

  /// Where the place at (x, y) texels of the layout lies, counted from the middle of its first texel; patch -1 in tiles
  /// and margins that no patch has.
  AtlasPlace place_at(double x, double y) const;

  /// The texel of the layout that shows a place with whole coordinates: index of its row-by-row order.
  std::size_t texel_of(const AtlasPlace& place) const;

  /// The place inside a patch that a place beyond a border means: as far behind the border in the neighbour as the
  /// place is before it. Beyond a corner the border that is farther away is crossed first. At the surface's boundary
  /// the patch is mirrored in it, its gutters too.
  AtlasPlace inside(AtlasPlace place) const;

  /// Of all names that a place on a border has in the patches that share it, the first: of the lowest patch, row
  /// and column. \pre a place inside, with whole coordinates
  AtlasPlace first_name(const AtlasPlace& place) const;

  /// The place of the patch itself that is nearest to a place beyond its border.
  Vec2d nearest_of_own_patch(const AtlasPlace& place) const;

  /// In the square of the patch, gutters left out, whether the patch has the place or not.
  bool within_patch(const AtlasPlace& p) const {
    return p.x >= 0 && p.y >= 0 && p.x <= last(p.patch) && p.y <= last(p.patch);
  }
  /// (u, v) of a place.
  Vec2d share_of(const AtlasPlace& p) const { return Vec2d(p.x, p.y) / last(p.patch); }

  /// The patch has the place: not so beyond the surface's boundary.
  bool exists(const AtlasPlace& place) const { return place.y >= place.x || !is_half(place.patch); }

  /// The surface ends there, inside of a patch.
  bool on_boundary(const AtlasPlace& place) const { return place.y == place.x && is_half(place.patch); }

 private:
  bool is_half(std::int32_t patch) const { return !image_.layout.places[patch].right.exists(); }
  AtlasPlace across(const AtlasPlace& place, std::int32_t side, double depth) const;

  const GeometryImage& image_;
  MapLayout layout_;
  std::vector<MapTile> tiles_;  ///< [patch] each is asked for at every texel
};

}  // namespace lozenge
