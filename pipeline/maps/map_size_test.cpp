#include "pipeline/maps/map_size.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "formats/patches/map_layout.h"
#include "formats/surface/attribute_streams.h"

namespace lozenge {
namespace {

std::string number(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text.push_back(static_cast<char>(value >> shift));
  return text;
}

/// The header of a square PNG, which is all that is looked at.
EncodedImage picture(std::uint32_t side) {
  const std::string text = std::string("\x89PNG\r\n\x1a\n", 8) + number(13) + "IHDR" + number(side) + number(side) +
                           std::string("\x08\x02\0\0\0", 5) + number(0) + number(1U << 20) + "IDAT" +
                           std::string(1U << 20, 'x') + number(0) + number(0) + "IEND" + number(0);
  return {"", "image/png", std::make_shared<const std::vector<unsigned char>>(text.begin(), text.end())};
}

/// A unit square that shows a picture from (0, 0) to (repeat, repeat).
SourceMesh square(std::uint32_t side, float repeat) {
  SourceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.materials = {0, 0};
  mesh.material_names = {"paint"};
  mesh.material_looks.resize(1);
  mesh.material_looks[0].texture(TextureRole::kBaseColour).image = 0;
  mesh.images.push_back(picture(side));
  AttributeStream& uv = stream_for(mesh.corner_attributes, kTextureCoordinates);
  for (const auto& t : mesh.triangles) {
    for (const VertexId v : t) {
      uv.values.push_back(repeat * mesh.positions[v].x);
      uv.values.push_back(repeat * mesh.positions[v].y);
    }
  }
  return mesh;
}

PatchLayout patches(std::size_t count) {
  PatchLayout layout;
  layout.places.resize(count);
  return layout;
}

TEST(MapSize, IsAsFineAsTheSourcesTextures) {
  EXPECT_EQ(map_size_for(square(1024, 1), patches(6)), 1024);
  EXPECT_EQ(map_size_for(square(1024, 0.5F), patches(6)), 512) << "a quarter of the picture";
  EXPECT_EQ(map_size_for(square(512, 4), patches(6)), 2048) << "a tiled picture needs as many texels as it covers";
}

TEST(MapSize, IsWithinBounds) {
  EXPECT_EQ(map_size_for(square(8192, 1), patches(6)), 4096);
  EXPECT_EQ(map_size_for(square(1, 1), patches(6)), 256);
  const PatchLayout many = patches(30'000);
  EXPECT_GE(map_size_for(square(256, 1), many), least_map_size(many)) << "tiles need room";
}

TEST(MapSize, IsTheUsualOneWhereTheSourceHasNoTextures) {
  SourceMesh plain = square(1024, 1);
  plain.images.clear();
  plain.material_looks[0] = Material();
  EXPECT_EQ(map_size_for(plain, patches(6)), default_map_size(patches(6)));
}

TEST(MapSize, IsWhatWasAskedFor) {
  BakeOptions options;
  options.size = 300;
  EXPECT_EQ(with_map_size(options, square(1024, 1), patches(6)).size, 300);
}

}  // namespace
}  // namespace lozenge
