// Every inner texel of every patch is baked once, into its own place of the map; then borders take the texel of the
// patch that owns them, and gutters that of the neighbour which they continue. Tangent-space normals come last: the
// object-space normal of every texel, gutters too, in the frame of the texel's own patch.
#include "stages/bake/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "stages/bake/atlas.h"
#include "stages/bake/occlusion.h"
#include "stages/bake/projector.h"
#include "stages/bake/target_surface.h"

namespace lozenge {

namespace {

constexpr std::int32_t kMostOcclusionRays = 65536;

void require_usable(const BakeOptions& options, const GeometryImage& image) {
  const auto usable_length = [](double length) { return std::isfinite(length) && length >= 0; };
  if (options.level < 0 || options.level >= static_cast<int>(image.levels.size())) {
    throw Error(ExitCode::kUsage, fmt::format("there is no level of detail {}; the geometry image has levels 0 to {}",
                                              options.level, static_cast<int>(image.levels.size()) - 1));
  }
  if (options.cage_distance && !usable_length(*options.cage_distance)) {
    throw Error(ExitCode::kUsage, fmt::format("a cage of {} is no length; give 0 or more", *options.cage_distance));
  }
  if (!usable_length(options.occlusion_distance)) {
    throw Error(ExitCode::kUsage,
                fmt::format("an occlusion distance of {} is no length; give 0 (everything occludes) or more",
                            options.occlusion_distance));
  }
  if (options.occlusion_rays < 1 || options.occlusion_rays > kMostOcclusionRays) {
    throw Error(ExitCode::kUsage, fmt::format("{} occlusion rays a texel are out of range; choose 1 to {}",
                                              options.occlusion_rays, kMostOcclusionRays));
  }
  if (options.occlusion_size < 1) {
    throw Error(ExitCode::kUsage, fmt::format("an occlusion map of {0} x {0} texels can't be made; choose 1 or more",
                                              options.occlusion_size));
  }
}

/// \throws Error where the geometry image's patches are not those of the map's domain
void require_same_patches(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image) {
  const std::vector<DomainSide> domain_edges = edges(map.domain);
  bool same = map.phi.size() == mesh.positions.size() && domain_edges.size() == image.layout.places.size();
  for (std::size_t p = 0; p < domain_edges.size() && same; ++p) {
    same = image.layout.places[p].left == domain_edges[p] &&
           image.layout.places[p].right == map.domain.neighbour(domain_edges[p]);
  }
  if (!same) {
    throw Error(
        ExitCode::kUnusableInput,
        fmt::format("the geometry image ({} patches) and the parameterization of {} ({} domain edges) don't belong "
                    "together; sample and pack this parameterization again",
                    image.layout.places.size(), mesh.origin, domain_edges.size()));
  }
}

/// See BakeOptions::occlusion_size.
std::int32_t occlusion_shrink(const BakeOptions& options) {
  std::int32_t shrink = std::clamp(options.size / options.occlusion_size, 1, std::max(options.gutter, 1));
  while (options.size % shrink != 0) --shrink;
  return shrink;
}

/// What one row of texels took.
struct Tally {
  std::int64_t texels = 0;
  std::int64_t rays = 0;
  std::int64_t fallbacks = 0;
  std::int64_t unused = 0;
};

class Baker {
 public:
  Baker(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image, const BakeOptions& options,
        const Progress& progress)
      : options_(options),
        progress_(progress),
        atlas_(image, make_map_layout(image.columns, image.rows, options.size, options.gutter)),
        target_(image, options.level, atlas_.layout()),
        projector_(mesh, map, image, target_),
        normals_(mesh) {
    statistics_.cage_distance = options.cage_distance ? *options.cage_distance : projector_.measured_cage();
  }

  BakedMaps bake();

 private:
  BakedMap empty_map(MapKind kind) const;
  template <typename Work>
  void bake_rows(std::int64_t rows, std::string_view what, const Work& work);
  template <typename Work>
  void bake_inner_texels(std::string_view what, const Work& work);
  SourcePoint source_of(const AtlasPlace& place, Tally& tally) const;
  std::size_t tile_rows() const;
  AtlasPlace place_in_tile(std::size_t row, std::int32_t x) const;
  void continue_beyond_borders(BakedMap& map) const;

  const BakedMap& object_normals();
  BakedMap tangent_normals();
  BakedMap positions();
  BakedMap occlusion();
  float occlusion_at(const AtlasPlace& place, std::uint64_t seed, Tally& tally) const;

  const BakeOptions& options_;
  const Progress& progress_;
  Atlas atlas_;
  TargetSurface target_;
  Projector projector_;
  ShadingNormals normals_;
  std::optional<BakedMap> object_normals_;
  BakeStatistics statistics_;
  double ray_seconds_ = 0;
};

void store(BakedMap& map, std::size_t texel, const Vec3f& value) {
  // -0 + 0 = 0: -0 is never stored.
  for (int c = 0; c < 3; ++c) map.texels[3 * texel + static_cast<std::size_t>(c)] = value[c] + 0.0F;
}

Vec3f load(const BakedMap& map, std::size_t texel) {
  return {map.texels[3 * texel], map.texels[3 * texel + 1], map.texels[3 * texel + 2]};
}

BakedMap Baker::empty_map(MapKind kind) const {
  BakedMap map;
  map.kind = kind;
  map.layout = atlas_.layout();
  map.level = options_.level;
  map.channels = kind == MapKind::kOcclusion ? 1 : 3;
  map.shrink = kind == MapKind::kOcclusion ? occlusion_shrink(options_) : 1;
  const std::size_t texels = static_cast<std::size_t>(map.width()) * map.height();
  map.texels.assign(texels * map.channels, kind == MapKind::kOcclusion ? 1.0F : 0.0F);
  if (kind == MapKind::kTangentNormal) {
    for (std::size_t t = 0; t < texels; ++t) map.texels[3 * t + 2] = 1;
  }
  return map;
}

/// Calls work(row, tally) for all rows in parallel, and adds up what they took.
template <typename Work>
void Baker::bake_rows(std::int64_t rows, std::string_view what, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Tally> tallies(static_cast<std::size_t>(rows));
  for_each_index(tallies.size(), progress_, what,
                 [&](std::size_t row) { work(static_cast<std::int64_t>(row), tallies[row]); });
  std::int64_t rays = 0;
  for (const Tally& tally : tallies) {
    statistics_.texels += tally.texels;
    statistics_.fallback_texels += tally.fallbacks;
    statistics_.unused_texels += tally.unused;
    rays += tally.rays;
  }
  statistics_.rays += rays;
  if (rays > 0) ray_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Calls work(place, texel, tally) for every inner texel that its patch has.
template <typename Work>
void Baker::bake_inner_texels(std::string_view what, const Work& work) {
  const std::int32_t inner = atlas_.layout().inner();
  bake_rows(std::int64_t{atlas_.patches()} * inner, what, [&](std::int64_t row, Tally& tally) {
    for (std::int32_t x = 0; x < inner; ++x) {
      const AtlasPlace place{static_cast<std::int32_t>(row / inner), static_cast<double>(x),
                             static_cast<double>(row % inner)};
      if (!atlas_.exists(place)) {
        ++tally.unused;
        continue;
      }
      ++tally.texels;
      work(place, atlas_.texel_of(place), tally);
    }
  });
}

/// Where the surface ends, both it and the source are lines, which rays graze or miss: the correspondence is exact.
SourcePoint Baker::source_of(const AtlasPlace& place, Tally& tally) const {
  const double u = place.x / atlas_.last();
  const double v = place.y / atlas_.last();
  if (options_.projection == Projection::kRays && !atlas_.on_boundary(place)) {
    const auto seen = projector_.along_normal(target_.at(place.patch, u, v), statistics_.cage_distance, tally.rays);
    if (seen) return *seen;
    ++tally.fallbacks;
  }
  return projector_.correspondence(place.patch, u, v);
}

/// Rows of texels of all tiles, gutters too.
std::size_t Baker::tile_rows() const { return static_cast<std::size_t>(atlas_.patches()) * atlas_.layout().tile; }

/// Texel `x` of one of those rows.
AtlasPlace Baker::place_in_tile(std::size_t row, std::int32_t x) const {
  const MapLayout& layout = atlas_.layout();
  return {static_cast<std::int32_t>(row / layout.tile), static_cast<double>(x - layout.gutter),
          static_cast<double>(static_cast<std::int32_t>(row % layout.tile) - layout.gutter)};
}

/// Gutters, borders that another patch owns, and what lies beyond the surface's boundary.
void Baker::continue_beyond_borders(BakedMap& map) const {
  const MapLayout& layout = atlas_.layout();
  for_each_index(tile_rows(), true, [&](std::size_t row) {
    for (std::int32_t x = 0; x < layout.tile; ++x) {
      const AtlasPlace place = place_in_tile(row, x);
      const AtlasPlace owner = atlas_.first_name(atlas_.inside(place));
      if (owner != place) store(map, atlas_.texel_of(place), load(map, atlas_.texel_of(owner)));
    }
  });
}

const BakedMap& Baker::object_normals() {
  if (object_normals_) return *object_normals_;
  object_normals_ = empty_map(MapKind::kObjectNormal);
  bake_inner_texels("baking normals", [&](const AtlasPlace& place, std::size_t texel, Tally& tally) {
    const SourcePoint source = source_of(place, tally);
    store(*object_normals_, texel, normals_.at(source.triangle, source.weights));
  });
  continue_beyond_borders(*object_normals_);
  return *object_normals_;
}

BakedMap Baker::tangent_normals() {
  const BakedMap& object = object_normals();
  BakedMap map = empty_map(MapKind::kTangentNormal);
  const MapLayout& layout = atlas_.layout();
  for_each_index(tile_rows(), progress_, "turning normals into tangent space", [&](std::size_t row) {
    for (std::int32_t x = 0; x < layout.tile; ++x) {
      const AtlasPlace place = place_in_tile(row, x);
      const std::size_t texel = atlas_.texel_of(place);
      const Vec2d at = atlas_.nearest_of_own_patch(place) / atlas_.last();
      store(map, texel, Vec3f(target_.at(place.patch, at.x, at.y).frame.to_texel(Vec3d(load(object, texel)))));
    }
  });
  return map;
}

BakedMap Baker::positions() {
  BakedMap map = empty_map(MapKind::kPosition);
  bake_inner_texels("baking positions", [&](const AtlasPlace& place, std::size_t texel, Tally&) {
    const SourcePoint source = projector_.correspondence(place.patch, place.x / atlas_.last(), place.y / atlas_.last());
    store(map, texel, position_at(projector_.mesh(), source));
  });
  continue_beyond_borders(map);
  return map;
}

/// Texels in gutters are baked like all others, for their places are not those of the neighbour's texels.
BakedMap Baker::occlusion() {
  BakedMap map = empty_map(MapKind::kOcclusion);
  bake_rows(map.height(), "baking occlusion", [&](std::int64_t y, Tally& tally) {
    for (std::int64_t x = 0; x < map.width(); ++x) {
      const double half = 0.5 * map.shrink - 0.5;
      const AtlasPlace place =
          atlas_.place_at(static_cast<double>(x) * map.shrink + half, static_cast<double>(y) * map.shrink + half);
      if (place.patch < 0) continue;
      const AtlasPlace inside = atlas_.inside(place);
      const auto texel = static_cast<std::size_t>(y * map.width() + x);
      Tally own;
      map.texels[texel] = occlusion_at(inside, texel, own);
      tally.rays += own.rays;
      if (inside != place) {  // in the gutter, or beyond the surface's boundary
        tally.unused += atlas_.within_patch(place);
        continue;
      }
      ++tally.texels;
      tally.fallbacks += own.fallbacks;
    }
  });
  return map;
}

float Baker::occlusion_at(const AtlasPlace& place, std::uint64_t seed, Tally& tally) const {
  const SourcePoint source = source_of(place, tally);
  const OcclusionPoint point{Vec3d(position_at(projector_.mesh(), source)), projector_.face_normal(source.triangle),
                             Vec3d(normals_.at(source.triangle, source.weights))};
  const double everything = std::numeric_limits<double>::infinity();
  const double farthest = options_.occlusion_distance > 0 ? options_.occlusion_distance : everything;
  return openness(projector_.scene(), point, {options_.occlusion_rays, 10 * projector_.tiny(), farthest}, seed,
                  tally.rays);
}

BakedMaps Baker::bake() {
  BakedMaps result;
  result.level = options_.level;
  for (const MapKind kind : options_.maps) {
    switch (kind) {
      case MapKind::kTangentNormal:
        result.maps.push_back(tangent_normals());
        break;
      case MapKind::kObjectNormal:
        result.maps.push_back(object_normals());
        break;
      case MapKind::kOcclusion:
        result.maps.push_back(occlusion());
        break;
      case MapKind::kPosition:
        result.maps.push_back(positions());
        break;
    }
  }
  if (ray_seconds_ > 0) statistics_.rays_per_second = static_cast<double>(statistics_.rays) / ray_seconds_;
  result.statistics = statistics_;
  return result;
}

}  // namespace

BakedMaps bake(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
               const BakeOptions& options, const Progress& progress) {
  require_usable(options, image);
  require_same_patches(mesh, map, image);
  report(progress, "preparing to bake", 0);
  return Baker(mesh, map, image, options, progress).bake();
}

}  // namespace lozenge
