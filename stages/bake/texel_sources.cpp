#include "stages/bake/texel_sources.h"

#include <algorithm>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/atlas.h"
#include "formats/patches/patch_place.h"

namespace lozenge {
namespace {

/// Whether the patches are those of this domain.
bool belong_together(const std::vector<PatchPlace>& places, const Domain& domain) {
  const std::vector<DomainSide> sides = edges(domain);
  return std::equal(places.begin(), places.end(), sides.begin(), sides.end(),
                    [&](const PatchPlace& place, const DomainSide& side) {
                      return place.left == side && place.right == domain.neighbour(side);
                    });
}

}  // namespace

std::vector<SourcePoint> texel_sources(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image,
                                       const MapLayout& layout, const Progress& progress) {
  if (!belong_together(image.layout.places, map.domain)) {
    throw Error(ExitCode::kUsage, mesh.origin + ": its map isn't the one that this geometry image was sampled by");
  }
  const Atlas atlas(image, layout);
  const DomainLocator locator(mesh, map);
  const auto width = static_cast<std::size_t>(layout.width);
  std::vector<SourcePoint> sources(width * static_cast<std::size_t>(layout.height));
  for_each_index(static_cast<std::size_t>(layout.height), progress, "finding the texels' places", [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::int32_t patch = layout.patch_at(static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
      if (patch < 0) continue;
      const MapTile& tile = atlas.tile(patch);
      const AtlasPlace here{patch, static_cast<double>(x) - tile.x - tile.gutter,
                            static_cast<double>(y) - tile.y - tile.gutter};
      const AtlasPlace place = atlas.first_name(atlas.inside(here));
      const Vec2d at = atlas.share_of(place);
      const auto found = locator.find(domain_point_at(image.layout.places[place.patch], at.x, at.y));
      if (!found)
        throw Error(ExitCode::kUnusableInput, mesh.origin + ": its map leaves a place of the domain uncovered");
      sources[y * width + x] = *found;
    }
  });
  return sources;
}

}  // namespace lozenge
