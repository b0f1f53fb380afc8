#include "formats/image_fixtures.h"

#include <cmath>

#include "formats/level_mesh.h"
#include "formats/patch_neighbours.h"
#include "formats/patch_place.h"
#include "formats/source_locator.h"
#include "formats/sphere_fixtures.h"

namespace lozenge::fixtures {

namespace {

/// Every name of a sample gets the bits of the lowest one.
void share_borders(PatchSet& patches) {
  const PatchNeighbours neighbours(patches.samples, patches.adjacency);
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.samples; ++j) {
      for (std::int32_t i = 0; i < patches.samples; ++i) {
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
  image.samples = patches.samples;
  image.columns = static_cast<std::int32_t>(std::ceil(std::sqrt(patches.size())));
  image.rows = (patches.size() + image.columns - 1) / image.columns;
  image.places = patches.places;
  image.adjacency = patches.adjacency;
  image.bounds = patches.bounds;
  image.scene_name = patches.scene_name;
  image.origin = patches.origin;
  image.double_sided = patches.double_sided;
  image.repeats = patches.repeats;
  for (int l = 0; (patches.samples - 1) >> l > 0; ++l) {
    GeometryLevel level;
    level.samples = ((patches.samples - 1) >> l) + 1;
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

AssetLevel asset_level(const GeometryImage& image, int level) {
  const LevelMesh mesh = level_mesh(image, level);
  AssetLevel result;
  result.name = "level " + std::to_string(level);
  result.positions = mesh.positions;
  result.triangles = mesh.triangles;
  result.material = 0;
  for (const Vec3f& p : mesh.positions) {
    const Vec3d n = Vec3d(p).normalized();
    const Vec3d t = n.cross(std::abs(n.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0)).normalized();
    result.normals.emplace_back(n);
    result.tangents.emplace_back(static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z), 1.0F);
    result.uvs.emplace_back(p.x / 2 + 0.5F, p.y / 2 + 0.5F);
  }
  return result;
}

}  // namespace

PatchSet sphere_patches(const Domain& base, int k) {
  // One source triangle for each domain triangle, with the same corners.
  const auto [mesh, map] = subdivided_sphere(base, 1);
  PatchSet patches;
  patches.samples = (1 << k) + 1;
  patches.places = patch_places(base);
  patches.adjacency = patch_adjacency(patches.places);
  patches.bounds = {{-1, -1, -1}, {1, 1, 1}};
  patches.scene_name = mesh.scene_name;
  patches.origin = mesh.origin;
  for (const PatchPlace& place : patches.places) {
    for (std::int32_t j = 0; j < patches.samples; ++j) {
      for (std::int32_t i = 0; i < patches.samples; ++i) {
        const double step = 1.0 / (patches.samples - 1);
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
  patches.samples = (1 << k) + 1;
  patches.places = patch_places(open.map.domain);
  patches.adjacency = patch_adjacency(patches.places);
  patches.bounds = bounds_of(open.mesh.positions);
  patches.scene_name = open.mesh.scene_name;
  patches.origin = open.mesh.origin;
  const std::size_t count = patches.places.size() * patches.samples * patches.samples;
  patches.positions.assign(count, Vec3f(0, 0, 0));
  patches.normals = patches.source_weights = patches.positions;
  patches.source_triangles.assign(count, -1);
  for (std::int32_t p = 0; p < patches.size(); ++p) {
    for (std::int32_t j = 0; j < patches.samples; ++j) {
      for (std::int32_t i = 0; i < (patches.places[p].right.exists() ? patches.samples : j + 1); ++i) {
        const double step = 1.0 / (patches.samples - 1);
        const SourcePoint source = locator.find(domain_point_at(patches.places[p], i * step, j * step)).value();
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

Asset sphere_asset() {
  const GeometryImage image = sphere_image(icosahedron(), 3);
  Asset asset;
  asset.scene_name = "sphere";
  asset.levels = {asset_level(image, 0), asset_level(image, 1)};
  AssetTexture flat;
  flat.name = "normal";
  flat.mime_type = "image/png";
  flat.width = 8;
  flat.height = 8;
  flat.channels = 3;
  flat.bits = 8;
  for (int texel = 0; texel < flat.width * flat.height; ++texel) {
    flat.pixels.insert(flat.pixels.end(), {128 / 255.0F, 128 / 255.0F, 1.0F});
  }
  asset.textures.push_back(flat);
  AssetMaterial material;
  material.name = "sphere";
  material.normal = 0;
  asset.materials.push_back(material);
  return asset;
}

BakedMap flat_normal_map() {
  BakedMap map;
  map.layout = {24, 16, 3, 2, 8, 1};
  for (int texel = 0; texel < map.layout.width * map.layout.height; ++texel) {
    map.texels.insert(map.texels.end(), {0.0F, 0.0F, 1.0F});
  }
  return map;
}

}  // namespace lozenge::fixtures
