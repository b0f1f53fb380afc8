#include "pipeline/maps/map_size.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/files/picture_header.h"
#include "formats/patches/map_layout.h"

namespace lozenge {

namespace {

/// [image] width and height in texels; 0 where it can't be read.
std::vector<Vec2d> sizes_of_images(const SourceMesh& mesh) {
  std::vector<Vec2d> sizes;
  for (const EncodedImage& image : mesh.images) {
    Vec2d& size = sizes.emplace_back(0, 0);
    if (image.bytes == nullptr || find_texture_defect(*image.bytes)) continue;
    if (const auto header = read_picture_header(*image.bytes)) size = Vec2d(header->width, header->height);
  }
  return sizes;
}

/// How many texels of a texture a triangle covers.
double texels_on(const SourceMesh& mesh, std::size_t t, const TextureUse& use, const Vec2d& size) {
  const AttributeStream* coordinates = find_stream(mesh.corner_attributes, kTextureCoordinates, use.set);
  if (coordinates == nullptr) return 0;
  const auto at = [&](std::size_t corner) { return Vec2d(vector_at<Vec2f>(*coordinates, 3 * t + corner)); };
  const Vec2d a = step_in_texture(use, at(1) - at(0));
  const Vec2d b = step_in_texture(use, at(2) - at(0));
  return 0.5 * std::abs(a.x * b.y - a.y * b.x) * size.x * size.y;
}

}  // namespace

double texels_of_textures(const SourceMesh& mesh) {
  const std::vector<Vec2d> sizes = sizes_of_images(mesh);
  double sum = 0;
  for (std::size_t t = 0; t < mesh.materials.size(); ++t) {
    double most = 0;
    for (const TextureUse& use : mesh.material_looks[mesh.materials[t]].textures) {
      if (use.exists()) most = std::max(most, texels_on(mesh, t, use, sizes[use.image]));
    }
    if (std::isfinite(most)) sum += most;
  }
  return sum;
}

std::int32_t map_size_for(const SourceMesh& mesh, const PatchLayout& patches) {
  constexpr std::int32_t kLeast = 256;
  constexpr std::int32_t kMost = 4096;
  constexpr std::int32_t kUsual = 2048;
  constexpr double kInner = 0.75;    // of an atlas's texels
  constexpr double kNearest = 1.41;  // the nearest power of two: the next one costs four times as much
  const std::int32_t usual = default_map_size(patches);
  if (mesh.images.empty() || mesh.material_looks.empty()) return usual;
  const double texels = texels_of_textures(mesh);
  if (!(texels > 0)) return usual;
  std::int32_t size = kLeast;
  while (size < kMost && kInner * std::pow(kNearest * size, 2) < texels) size *= 2;
  return usual > kUsual ? std::max(size, usual) : std::max<std::int64_t>(size, least_map_size(patches));
}

BakeOptions with_map_size(const BakeOptions& options, const SourceMesh& mesh, const PatchLayout& patches) {
  BakeOptions sized = options;
  if (sized.size == 0) sized.size = map_size_for(mesh, patches);
  return sized;
}

}  // namespace lozenge
