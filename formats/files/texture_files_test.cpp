#include "formats/files/texture_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/base/srgb.h"
#include "formats/files/readers/gltf/buffers.h"

namespace lozenge {
namespace {

/// A PNG of 2 x 2 pixels: the upper row is 200 of 255 in all channels, the lower one 90.
std::vector<unsigned char> picture() {
  return decode_data_uri(
      "data:image/"
      "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAD0lEQVR4nGM4AQYMUWAAADioBs3w9rF5AAAAAElFTkSuQmCC");
}

SourceMesh mesh_with(std::vector<unsigned char> bytes) {
  SourceMesh mesh;
  mesh.origin = "a.glb";
  mesh.material_names = {"paint"};
  mesh.material_looks.resize(1);
  mesh.images.push_back({"rows", "image/png", std::make_shared<const std::vector<unsigned char>>(std::move(bytes))});
  for (const TextureRole role : kTextureRoles) mesh.material_looks[0].texture(role).image = 0;
  return mesh;
}

constexpr std::array kRoles{TextureRole::kBaseColour, TextureRole::kMetallicRoughness};

constexpr double kUpper = 200.0 / 255;
constexpr double kLower = 90.0 / 255;
/// Of the half floats that texels are kept in.
constexpr double kRounding = 1e-3;

TEST(TextureFiles, GiveColoursAsLightAndQuantitiesAsTheyAreStoredWithTheFirstRowOnTop) {
  const SourceMesh mesh = mesh_with(picture());
  const TextureFiles textures(mesh, kRoles);
  EXPECT_TRUE(textures.notes().empty());
  const TextureUse& use = mesh.material_looks[0].texture(TextureRole::kBaseColour);
  const TextureFootprint upper{{0.5, 0.25}, {0.01, 0}, {0, 0.01}};
  const TextureFootprint lower{{0.5, 0.75}, {0.01, 0}, {0, 0.01}};
  EXPECT_NEAR(textures.look_up(use, TextureRole::kBaseColour, upper).x, linear_of_srgb(kUpper), kRounding);
  EXPECT_NEAR(textures.look_up(use, TextureRole::kBaseColour, lower).y, linear_of_srgb(kLower), kRounding);
  EXPECT_NEAR(textures.look_up(use, TextureRole::kMetallicRoughness, upper).z, kUpper, kRounding);
  EXPECT_EQ(textures.look_up(use, TextureRole::kMetallicRoughness, upper).w, 1);
}

TEST(TextureFiles, AverageOverLargeFootprintsInLinearLight) {
  const SourceMesh mesh = mesh_with(picture());
  const TextureFiles textures(mesh, kRoles);
  const TextureUse& use = mesh.material_looks[0].texture(TextureRole::kBaseColour);
  const TextureFootprint all{{0.5, 0.5}, {4, 0}, {0, 4}};
  EXPECT_NEAR(textures.look_up(use, TextureRole::kBaseColour, all).x,
              (linear_of_srgb(kUpper) + linear_of_srgb(kLower)) / 2, 2 * kRounding);
}

TEST(TextureFiles, AreLookedUpAtPointsTooOnAnyThread) {
  const SourceMesh mesh = mesh_with(picture());
  const TextureFiles textures(mesh, kRoles);
  const TextureUse& use = mesh.material_looks[0].texture(TextureRole::kMetallicRoughness);
  std::vector<float> found(4096, -1);
  for_each_index(found.size(), true, [&](std::size_t i) {
    found[i] = textures.look_up(use, TextureRole::kMetallicRoughness, {{0.5, 0.25}, {0, 0}, {0, 0}}).x;
  });
  for (const float value : found) ASSERT_NEAR(value, kUpper, kRounding);
}

TEST(TextureFiles, GoOnBeyondTheirBordersAsTheSamplerSays) {
  const SourceMesh mesh = mesh_with(picture());
  const TextureFiles textures(mesh, kRoles);
  TextureUse use = mesh.material_looks[0].texture(TextureRole::kMetallicRoughness);
  const auto at = [&](double v) {
    return textures.look_up(use, TextureRole::kMetallicRoughness, {{0.5, v}, {0.01, 0}, {0, 0.01}}).x;
  };
  use.wrap_v = Wrap::kRepeat;
  EXPECT_NEAR(at(1.25), kUpper, kRounding);
  use.wrap_v = Wrap::kMirror;
  EXPECT_NEAR(at(1.25), kLower, kRounding);
  EXPECT_NEAR(at(1.75), kUpper, kRounding);
  use.wrap_v = Wrap::kClamp;
  EXPECT_NEAR(at(7.5), kLower, kRounding);
}

TEST(TextureFiles, LeaveOutWithANoteWhatCannotBeDecoded) {
  std::vector<unsigned char> broken = picture();
  broken[45] ^= 0x55U;  // in the compressed pixels
  broken[46] ^= 0x55U;
  const SourceMesh mesh = mesh_with(broken);
  const TextureFiles textures(mesh, kRoles);
  EXPECT_FALSE(textures.notes().empty());
  for (const TextureRole role : kRoles) {
    EXPECT_FALSE(textures.can_look_up(mesh.material_looks[0].texture(role), role));
  }
}

TEST(TextureFiles, RefuseAPictureThatTakesMoreMemoryThanAllowed) {
  const SourceMesh mesh = mesh_with(picture());
  try {
    const TextureFiles textures(mesh, kRoles, {.max_memory = 100});
    FAIL() << "was decoded";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kLimit) << error.what();
  }
}

}  // namespace
}  // namespace lozenge
