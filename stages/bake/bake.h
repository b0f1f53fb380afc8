// Texture maps over the atlas of a geometry image, taken from the source surface.
//
// Every texel has a place on the domain, and so, by the parameterization, a source point that belongs to it. Normals
// and occlusion come from what is seen from the level of detail instead: rays from its surface both ways along its
// interpolated normal, as far as the cage, take the nearer point that faces the same way. That keeps details where a
// renderer will show them, and the correspondence fills in for every ray that misses or meets a back side.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "formats/domain/parameterization.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/textures.h"

namespace lozenge {

/// How the source point of a texel is found, for normals and occlusion. Positions always come from the correspondence.
enum class Projection { kRays, kCorrespondence };

/// Where what darkens corners comes from.
enum class OcclusionOf {
  kAuto,    ///< an asset whose look someone made (textures, colours, materials that differ) keeps it; for one that
            ///< doesn't, it is baked
  kBaked,   ///< from the surface by rays, times what the source's occlusion textures say
  kSource,  ///< those textures alone
};

/// The side that one of the maps shall have, in texels.
struct MapSize {
  MapKind kind = MapKind::kBaseColour;
  std::int32_t size = 0;
};

/// Where bodies are while rays look for what hides them.
enum class OcclusionPose : std::uint8_t {
  kRest,       ///< all where they stand at rest
  kModelling,  ///< each by itself, where it was modelled
};

struct BakeOptions {
  /// None: `usual_maps`, but those that turn out to be the same everywhere (BakedMap::constants).
  std::vector<MapKind> maps;
  bool source_level = true;    ///< whether `usual_maps` are for the source's own triangles, too
  std::int32_t size = 0;       ///< of the square texture, in texels; 0: `default_map_size`
  std::vector<MapSize> sizes;  ///< of maps that shall have other ones; see `map_shrink`
  /// Texels around each patch that continue it into its neighbours; fewer of small tiles. Nothing: `default_gutter`.
  std::optional<std::int32_t> gutter;
  int level = 0;  ///< the level of detail that the maps are for; 0 is the finest

  Projection projection = Projection::kRays;
  /// How far rays go on either side of the level of detail, in the asset's units. Nothing: measured, see
  /// `measured_cage`.
  std::optional<double> cage_distance;

  OcclusionOf occlusion = OcclusionOf::kAuto;
  OcclusionPose occlusion_pose = OcclusionPose::kRest;
  /// Of the occlusion map's side, in texels. Rounded up until it divides `size` and the smallest tile, and a texel is
  /// no wider than two gutters.
  std::int32_t occlusion_size = 512;
  std::int32_t occlusion_rays = 64;  ///< a texel, spread by the cosine
  /// What is farther doesn't occlude, in the asset's units. Nothing: `kOcclusionReach` of the diagonal of its box.
  std::optional<double> occlusion_distance;
};

/// A share of the diagonal of the asset's box, beyond which nothing occludes where nobody says otherwise. So a room
/// seen from inside isn't black, and of what lies under something large only the edge is dark.
inline constexpr double kOcclusionReach = 0.15;

/// Bakes all maps asked for, in the order asked. Where someone made the source's look, tiles that look alike lie side
/// by side (`order_of_alike`), and colours go on beyond the last ones; else texels of tiles that no patch has are flat:
/// tangent-space normals (0, 0, 1), occlusion 1, others 0. The same bytes on any number of threads. \throws
/// Error(kUsage) for options out of range, Error(kLimit) where the size is too small for the number of patches,
/// Error(kUnusableInput) where the three inputs don't belong together or the map is folded \param textures  of the
/// mesh's materials; without them, those are their factors alone
BakedMaps bake(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
               const BakeOptions& options = {}, const Progress& progress = {}, const Textures* textures = nullptr);

/// What is baked where nobody asks for other maps: normals, occlusion where it is to be baked, and what differs from
/// place to place of the source's base colour, roughness and metal (in one map with the occlusion), emission; and a map
/// of normals for its own triangles, where it has normal textures.
std::vector<MapKind> usual_maps(const BakeOptions& options, const SourceMesh& mesh);

/// The side of the texture that all maps are parts of, in texels: that of the largest.
std::int32_t atlas_size(const BakeOptions& options, const PatchLayout& patches);

/// A map's texel is the mean of so many texels of the texture, a side: a power of two, with which the map is as large
/// as is asked for or, where no such divides the smallest tile and leaves a gutter, the next larger.
std::int32_t map_shrink(const BakeOptions& options, MapKind kind, const MapLayout& layout);

/// What to tell of a surface whose occlusion has come out nearly all dark, as that of a room with a near ceiling; empty
/// where it hasn't.
std::string note_on_occlusion(const BakeStatistics& statistics);

/// What to tell of a surface that moves: in which pose its occlusion was traced; empty where it wasn't, or nothing
/// moves. \param maps  that were baked
std::string note_on_occlusion_pose(const BakeOptions& options, const BakedMaps& maps, const SourceMesh& mesh);

/// The textures of the source that go into maps, and those by which tiles are ordered.
std::vector<TextureRole> texture_roles(const BakeOptions& options, const SourceMesh& mesh);

}  // namespace lozenge
