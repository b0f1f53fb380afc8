#include "formats/files/asset_fixtures.h"

#include <cmath>

#include "formats/domain/sphere_fixtures.h"
#include "formats/patches/image_fixtures.h"
#include "formats/patches/level_mesh.h"

namespace lozenge::fixtures {

namespace {

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
  material.texture(MaterialSlot::kNormal) = 0;
  asset.materials.push_back(material);
  return asset;
}

}  // namespace lozenge::fixtures
