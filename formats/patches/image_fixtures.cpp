#include "formats/patches/image_fixtures.h"

#include <cmath>

#include "formats/domain/source_locator.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/level_mesh.h"
#include "formats/patches/patch_neighbours.h"
#include "formats/patches/patch_place.h"

namespace lozenge::fixtures {

namespace {

/// Every name of a sample gets the bits of the lowest one.
void share_borders(PatchSet& patches) {
  const PatchNeighbours neighbours(patches.layout.samples, patches.layout.adjacency);
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.layout.samples; ++j) {
      for (std::int32_t i = 0; i < patches.layout.samples; ++i) {
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
  image.rows = (patches.size() + image.columns - 1) / image.columns;
  for (int l = 0; (patches.layout.samples - 1) >> l > 0; ++l) {
    GeometryLevel level;
    level.samples = ((patches.layout.samples - 1) >> l) + 1;
    const auto texels = static_cast<std::size_t>(image.width(level)) * image.height(level);
    level.positions.assign(texels, Vec3f(0, 0, 0));
    level.normals.assign(texels, Vec3f(0, 0, 0));
    for (std::int32_t p = 0; p < patches.size(); ++p) {
      for (std::int32_t j = 0; j < level.samples; ++j) {
        for (std::int32_t i = 0; i < level.samples; ++i) {
          const std::size_t from = patches.index(p, i << l, j << l);
          level.positions[image.index(level, p, i, j)] = patches.positions[from];
          level.normals[image.index(level, p, i, j)] = patches.normals[from];
        }
      }
    }
    image.levels.push_back(level);
  }
  return image;
}

}  // namespace

PatchSet sphere_patches(const Domain& base, int k) {
  // One source triangle for each domain triangle, with the same corners.
  const auto [mesh, map] = subdivided_sphere(base, 1);
  PatchSet patches;
  patches.layout = patch_layout(mesh, base, (1 << k) + 1);
  patches.layout.bounds = {{-1, -1, -1}, {1, 1, 1}};
  for (const PatchPlace& place : patches.layout.places) {
    for (std::int32_t j = 0; j < patches.layout.samples; ++j) {
      for (std::int32_t i = 0; i < patches.layout.samples; ++i) {
        const double step = 1.0 / (patches.layout.samples - 1);
        const DomainPoint at = domain_point_at(place, i * step, j * step);
        const auto& [a, b, c] = mesh.triangles[at.triangle];
        const Vec3d point = Vec3d(mesh.positions[a]) * at.alpha + Vec3d(mesh.positions[b]) * at.beta +
                            Vec3d(mesh.positions[c]) * at.gamma();
        // + 0 turns -0 into +0.
        const Vec3f sample = Vec3f(point.normalized()) + Vec3f(0, 0, 0);
        patches.positions.push_back(sample);
        patches.normals.push_back(sample);
        patches.source_triangles.push_back(at.triangle);
        patches.source_weights.emplace_back(Vec3d(at.alpha, at.beta, at.gamma()));
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
  PatchSet patches;
  patches.layout = patch_layout(open.mesh, open.map.domain, (1 << k) + 1);
  const std::size_t count = patches.layout.places.size() * patches.layout.samples * patches.layout.samples;
  patches.positions.assign(count, Vec3f(0, 0, 0));
  patches.normals = patches.source_weights = patches.positions;
  patches.source_triangles.assign(count, -1);
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.layout.samples; ++j) {
      for (std::int32_t i = 0; i < (patches.layout.places[p].right.exists() ? patches.layout.samples : j + 1); ++i) {
        const double step = 1.0 / (patches.layout.samples - 1);
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

BakedMap flat_normal_map() {
  BakedMap map;
  map.layout = {24, 16, 3, 2, 8, 1};
  for (int texel = 0; texel < map.layout.width * map.layout.height; ++texel) {
    map.texels.insert(map.texels.end(), {0.0F, 0.0F, 1.0F});
  }
  return map;
}

}  // namespace lozenge::fixtures
