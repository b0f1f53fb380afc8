// What every baking function works with: the atlas, the surface that the maps are for, the source, and loops over
// texels that count what they took.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "formats/base/progress.h"
#include "formats/patches/atlas.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/target_surface.h"
#include "stages/bake/bake.h"
#include "stages/bake/projector.h"
#include "stages/bake/source_look.h"

namespace lozenge {

/// What one row of texels took; see BakeStatistics.
struct BakeTally {
  std::int64_t texels = 0;
  std::int64_t rays = 0;
  std::int64_t fallbacks = 0;
  std::int64_t unused = 0;
};

class AtlasBaker {
 public:
  /// Keeps references to all.
  /// \throws Error(kLimit) where the size is too small for the number of patches, Error(kUnusableInput) where the map
  /// is folded
  AtlasBaker(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
             const BakeOptions& options, const Textures* textures, const Progress& progress);

  const BakeOptions& options() const { return options_; }
  const Atlas& atlas() const { return atlas_; }
  const TargetSurface& target() const { return target_; }
  const Projector& projector() const { return projector_; }
  const ShadingNormals& normals() const { return normals_; }
  const SourceLook& look() const { return look_; }
  /// Of all that was baked so far.
  BakeStatistics statistics() const;
  void set_dark_share(double share) { statistics_.dark_share = share; }

  /// The source points that texels inside of patches show, as BakeOptions::projection says; found faster where they lie
  /// side by side.
  std::vector<SourcePoint> sources_of(std::span<const AtlasPlace> places, BakeTally& tally) const;
  /// The one that the parameterization says.
  SourcePoint correspondence(const AtlasPlace& place) const;

  /// What of the source a square of the atlas shows, by the parameterization; of its middle's triangle, though it may
  /// reach beyond it. \param side  of the square, in texels
  SourceFootprint footprint(const AtlasPlace& place, double side = 1) const;
  /// The same square, seen at another point of the source: where a ray from that place met it.
  SourceFootprint footprint_at(const SourcePoint& point, const AtlasPlace& place) const;

  /// A map of neutral texels for the options' level of detail.
  BakedMap neutral(MapKind kind, std::int32_t shrink = 1, std::int32_t channels = 0) const;

  /// Calls `work(row, tally)` for all rows in parallel, and adds up what they took.
  void bake_rows(std::size_t rows, std::string_view what, const std::function<void(std::size_t, BakeTally&)>& work);

  /// Calls `work(place, texel)` for every inner texel that its patch has: `texel` is its index in a map of the layout's
  /// resolution.
  void bake_inner_texels(std::string_view what, const std::function<void(const AtlasPlace&, std::size_t)>& work);

  /// The same with the source point that the texel shows: `work(place, texel, source)`.
  void bake_seen_texels(std::string_view what,
                        const std::function<void(const AtlasPlace&, std::size_t, const SourcePoint&)>& work);

  /// Calls `work(place, texel)` for every texel of every tile, gutters too, in parallel. An empty `what` is not worth
  /// telling.
  void for_each_texel(std::string_view what, const std::function<void(const AtlasPlace&, std::size_t)>& work) const;

  /// Fills gutters, borders that another patch owns, and what lies beyond the surface's boundary with the texels that
  /// they continue; of a map of lower resolution, with what a look-up gives there (formats/patches/shrunk_atlas.h).
  /// \pre  all inner texels are baked
  void continue_beyond_borders(BakedMap& map) const;

  /// Fills what no tile has with the last texel of the tiles to the left, or what lies above: so that mips of what lies
  /// beside it don't turn white. \pre in the layout's resolution
  void continue_beyond_tiles(BakedMap& map) const;

 private:
  /// One row of a tile's texels: places (begin, y) to (end - 1, y).
  struct TileRow {
    std::int32_t patch = -1;
    std::int32_t y = 0;
    std::int32_t begin = 0;
    std::int32_t end = 0;
  };
  std::vector<TileRow> rows_of_tiles(bool gutters) const;
  /// Those that the patch has.
  std::vector<AtlasPlace> places_of(const TileRow& row) const;
  /// Calls `work(places, tally)` for the inner texels of each row of each tile.
  void bake_places(std::string_view what, const std::function<void(std::span<const AtlasPlace>, BakeTally&)>& work);

  const BakeOptions& options_;
  const Progress& progress_;
  Projector projector_;
  ShadingNormals normals_;
  SourceLook look_;
  Atlas atlas_;
  TargetSurface target_;
  BakeStatistics statistics_;
  double ray_seconds_ = 0;
};

}  // namespace lozenge
