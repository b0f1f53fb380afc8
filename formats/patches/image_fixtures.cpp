#include "formats/patches/image_fixtures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "formats/domain/source_locator.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "formats/patches/patch_neighbours.h"
#include "formats/patches/patch_place.h"

namespace lozenge::fixtures {

namespace {

/// Every name of a sample gets the bits of the lowest one.
void share_borders(PatchSet& patches) {
  const PatchNeighbours neighbours(patches.layout);
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.grids.samples(p); ++j) {
      for (std::int32_t i = 0; i < patches.grids.samples(p); ++i) {
        const std::size_t here = patches.index(p, i, j);
        std::size_t lowest = here;
        for (const PatchSample& s : neighbours.names({p, i, j})) {
          lowest = std::min(lowest, patches.index(s.patch, s.i, s.j));
        }
        patches.positions[here] = patches.positions[lowest];
        patches.normals[here] = patches.normals[lowest];
      }
    }
  }
}

/// The patches in the squarest atlas, with all levels of detail.
GeometryImage packed(const PatchSet& patches) {
  GeometryImage image;
  image.layout = patches.layout;
  image.columns = static_cast<std::int32_t>(std::ceil(std::sqrt(patches.size())));
  for (std::int32_t l = 0; (patches.layout.samples - 1) >> l > 0; ++l) {
    GeometryLevel level = image.empty_level(l, false);
    for (std::int32_t p = 0; p < image.layout.count_on(l); ++p) {
      const std::int32_t halvings = l - image.layout.first_level(p);
      for (std::int32_t j = 0; j < level.samples; ++j) {
        for (std::int32_t i = 0; i < level.samples; ++i) {
          const std::size_t from = patches.index(p, i << halvings, j << halvings);
          level.positions[image.index(level, p, i, j)] = patches.positions[from];
          level.normals[image.index(level, p, i, j)] = patches.normals[from];
        }
      }
    }
    image.levels.push_back(std::move(level));
  }
  return image;
}

}  // namespace

PatchSet sphere_patches(const Domain& base, int k) {
  // One source triangle for each domain triangle, with the same corners.
  const auto [mesh, map] = subdivided_sphere(base, 1);
  PatchSet patches = empty_patch_set(patch_layout(mesh, map, (1 << k) + 1));
  patches.layout.bounds = {{-1, -1, -1}, {1, 1, 1}};
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.layout.samples; ++j) {
      for (std::int32_t i = 0; i < patches.layout.samples; ++i) {
        const double step = 1.0 / (patches.layout.samples - 1);
        const DomainPoint at = domain_point_at(patches.layout.places[p], i * step, j * step);
        const auto& [a, b, c] = mesh.triangles[at.triangle];
        const Vec3d point = Vec3d(mesh.positions[a]) * at.alpha + Vec3d(mesh.positions[b]) * at.beta +
                            Vec3d(mesh.positions[c]) * at.gamma();
        // + 0 turns -0 into +0.
        const Vec3f sample = Vec3f(point.normalized()) + Vec3f(0, 0, 0);
        const std::size_t index = patches.index(p, i, j);
        patches.positions[index] = sample;
        patches.normals[index] = sample;
        patches.source_triangles[index] = at.triangle;
        patches.source_weights[index] = Vec3f(Vec3d(at.alpha, at.beta, at.gamma()));
      }
    }
  }
  share_borders(patches);
  return patches;
}

GeometryImage sphere_image(const Domain& base, int k) { return packed(sphere_patches(base, k)); }

PatchSet open_patches(const OpenSurface& open, int k) {
  const DomainLocator locator(open.mesh, open.map);
  const ShadingNormals normals(open.mesh);
  PatchSet patches = empty_patch_set(patch_layout(open.mesh, open.map, (1 << k) + 1));
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    const std::int32_t samples = patches.grids.samples(p);
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < (patches.layout.places[p].right.exists() ? samples : j + 1); ++i) {
        const double step = 1.0 / (samples - 1);
        const SourcePoint source = locator.find(domain_point_at(patches.layout.places[p], i * step, j * step)).value();
        const std::size_t at = patches.index(p, i, j);
        patches.positions[at] = position_at(open.mesh, source);
        patches.normals[at] = normals.at(source.triangle, source.weights) + Vec3f(0, 0, 0);
        patches.source_triangles[at] = source.triangle;
        patches.source_weights[at] = Vec3f(source.weights);
      }
    }
  }
  share_borders(patches);
  return patches;
}

GeometryImage open_image(const OpenSurface& open, int k) { return packed(open_patches(open, k)); }

PatchLayout patches_of_one_scale(std::int32_t count) {
  PatchLayout layout;
  layout.places.resize(static_cast<std::size_t>(count));
  return layout;
}

TileOrder random_order(const MapLayout& layout, std::mt19937& random) {
  std::vector<std::int32_t> tiles(static_cast<std::size_t>(layout.patches()));
  std::iota(tiles.begin(), tiles.end(), 0);
  auto first = tiles.begin();
  for (const std::int32_t count : layout.counts) {
    std::shuffle(first, first + count, random);
    first += count;
  }
  return TileOrder(std::move(tiles));
}

BakedMap flat_normal_map() {
  BakedMap map;
  map.layout = {24, 16, 3, 8, 1, {6}};
  for (int texel = 0; texel < map.layout.width * map.layout.height; ++texel) {
    map.texels.insert(map.texels.end(), {0.0F, 0.0F, 1.0F});
  }
  return map;
}

}  // namespace lozenge::fixtures
