// Texture maps over the atlas of a geometry image.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/map_kinds.h"
#include "formats/patches/map_layout.h"

namespace lozenge {

/// Where y of tangent-space normals points in a picture: up as in OpenGL and glTF, or down as in DirectX.
enum class NormalY : std::uint8_t { kUp, kDown };

/// A map as the bytes of a PNG of so many bits a channel.
struct EncodedMap {
  int bits = 8;
  NormalY normal_y = NormalY::kUp;
  std::vector<std::uint8_t> bytes;
};

/// What a map would hold that is the same everywhere: the asset's material has it as its factors.
struct ConstantMap {
  MapKind kind = MapKind::kBaseColour;
  std::array<float, 4> value{1, 1, 1, 1};  ///< [channel]; of those that it doesn't have, 1

  bool operator==(const ConstantMap&) const = default;
};

/// One map: `channels` floats a texel, row by row from the top. Normals are unit vectors, occlusion is 0 (dark) to 1,
/// colours are linear, positions are in the asset's units; what else there is to know of its kind is in map_kinds.h.
///
/// All maps of a surface have the same texture coordinates, hence the same layout. A map of lower resolution
/// (occlusion) has one texel for every `shrink` x `shrink` texels of the layout: its centre is the middle of theirs.
struct BakedMap {
  MapKind kind = MapKind::kTangentNormal;
  MapLayout layout;
  std::int32_t channels = 3;
  std::vector<float> texels;
  std::int32_t shrink = 1;  ///< divides the layout's width and height
  std::int32_t level = 0;   ///< the level of detail that it was baked for
  /// The same texels, encoded; null where nobody did that yet. Who changes texels takes it away.
  std::shared_ptr<const EncodedMap> png{};
  /// What else was baked with it, and is no map because it is the same everywhere. The first map of a bake says so, in
  /// its file, too.
  std::vector<ConstantMap> constants{};

  std::int32_t width() const { return layout.width / shrink; }    ///< in texels of this map
  std::int32_t height() const { return layout.height / shrink; }  ///< in texels of this map
};

/// A map whose texels are all neutral. \param shrink  divides the layout's width and height
/// \param channels  0: all that the kind has
BakedMap neutral_map(MapKind kind, const MapLayout& layout, std::int32_t level, std::int32_t shrink = 1,
                     std::int32_t channels = 0);

struct BakeStatistics {
  std::int64_t texels = 0;  ///< baked, over all maps, gutters left out
  std::int64_t rays = 0;
  double rays_per_second = 0;        ///< a time: left out of every output but the report
  std::int64_t fallback_texels = 0;  ///< whose ray missed or hit a back side, and took the correspondence's point
  double cage_distance = 0;          ///< in the asset's units
  /// Inside of patches, over all maps, but beyond the surface's boundary: they mirror what lies before it, so that
  /// filtering doesn't show the edge. Not among the others.
  std::int64_t unused_texels = 0;
  std::optional<double> dark_share{};  ///< of the baked occlusion's texels: those that see less than a tenth of the sky
  std::int32_t map_size = 0;           ///< the side of the largest maps, in texels
  std::vector<MapKind> constant_maps{};  ///< those that were left out, because they are the same everywhere
};

/// The map of this kind; null where there is none.
const BakedMap* find_map(const std::vector<BakedMap>& maps, MapKind kind);

struct BakedMaps {
  std::vector<BakedMap> maps;
  /// The level of detail whose tangent frames the tangent-space normals are in.
  std::int32_t level = 0;
  BakeStatistics statistics;

  /// Nothing where it wasn't baked.
  const BakedMap* find(MapKind kind) const;
  /// What is no map because it is the same everywhere; of a kind that is there as a map as well, the map counts.
  std::vector<ConstantMap> constants() const;
  /// The map that holds only for the tangent frames of the level that it was baked for; nothing where there is none.
  const BakedMap* find_in_level_frames() const;
};

/// Texel number `texel` of a map of three channels. -0 is never stored.
void store(BakedMap& map, std::size_t texel, const Vec3f& value);
Vec3f load(const BakedMap& map, std::size_t texel);

}  // namespace lozenge
