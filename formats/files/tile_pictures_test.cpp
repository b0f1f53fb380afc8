#include "formats/files/tile_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/base/file_fixtures.h"
#include "formats/files/openimageio.h"

namespace lozenge {
namespace {

struct Pixels {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint16_t> values;

  /// Number n of [patch, row, column, channel], for tiles of `side` in so many columns.
  std::uint16_t at(std::int64_t columns, std::int64_t side, std::int64_t patch, std::int64_t row, std::int64_t column,
                   std::int64_t channel) const {
    const std::int64_t y = patch / columns * side + row;
    return values[static_cast<std::size_t>((y * width + patch % columns * side + column) * channels + channel)];
  }
};

Pixels read_png(const std::filesystem::path& path) {
  const auto in = OIIO::ImageInput::open(path.string());
  if (!in) return {};
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::UINT16) << path;
  Pixels pixels{in->spec().width, in->spec().height, in->spec().nchannels, {}};
  pixels.values.resize(static_cast<std::size_t>(pixels.width) * pixels.height * pixels.channels);
  EXPECT_TRUE(in->read_image(0, 0, 0, pixels.channels, OIIO::TypeDesc::UINT16, pixels.values.data()));
  return pixels;
}

TEST(TilePictures, HoldEachNumberToHalfAStepAndIntegersExactly) {
  constexpr int kPatches = 5;  // of which the last row has two
  constexpr int kSide = 3;
  std::vector<float> places;
  std::vector<std::int32_t> triangles;
  for (int n = 0; n < kPatches * kSide * kSide; ++n) {
    places.insert(places.end(), {static_cast<float>(std::sin(n)), static_cast<float>(100 * std::cos(n)), 7});
    triangles.push_back(n == 3 ? -1 : n * 4001);
  }
  const std::vector<NamedArray> arrays = {
      {"positions", {kPatches, kSide, kSide, 3}, places, {{-1, 1}, {-100, 100}, {7, 7}}},
      {"source_triangles.2", {kPatches, kSide, kSide}, triangles, {{-1, 0}}},
      {"first_levels", {kPatches}, std::vector<std::int32_t>(kPatches, 0)}};
  const fixtures::TestFolder folder;
  write_tile_pictures(folder / "some.json", R"({"kind": "geometry image"})", arrays);
  const auto json = nlohmann::json::parse(std::ifstream(folder / "some.json"));
  EXPECT_EQ(json["geometry_image"]["kind"], "geometry image");
  ASSERT_EQ(json["pictures"].size(), 2U);
  EXPECT_EQ(json["pictures"][0]["ranges"][1][0], -100);
  const Pixels positions = read_png(folder / std::string(json["pictures"][0]["file"]));
  const Pixels sources = read_png(folder / "some.source_triangles.2.png");
  ASSERT_EQ(positions.width, 3 * kSide);
  ASSERT_EQ(positions.height, 2 * kSide);
  for (int n = 0; n < kPatches * kSide * kSide; ++n) {
    const int patch = n / (kSide * kSide);
    const int row = n / kSide % kSide;
    const int column = n % kSide;
    for (int c = 0; c < 3; ++c) {
      const auto& range = arrays[0].ranges[c];
      const double value = range[0] + (range[1] - range[0]) * positions.at(3, kSide, patch, row, column, c) / 65535;
      EXPECT_NEAR(value, places[3 * n + c], 0.51 * (range[1] - range[0]) / 65535 + 1e-6);
    }
    EXPECT_EQ(65536 * sources.at(3, kSide, patch, row, column, 0) + sources.at(3, kSide, patch, row, column, 1) - 1,
              triangles[n]);
  }
}

}  // namespace
}  // namespace lozenge
