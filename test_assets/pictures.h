// Pictures of functions, for the textures of the test assets.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "test_assets/gltf_writer.h"
#include "test_assets/png_writer.h"

namespace lozenge::test_assets {

constexpr std::uint32_t kSide = 64;
constexpr double kTurn = 6.28318530717958648;

using SharesWithAlpha = std::array<double, 4>;
using Shares = std::array<double, 3>;

/// As a PNG. \param colour  of a place from 0 to 1: three shares, or four
template <typename Colour>
std::vector<std::uint8_t> picture(const Colour& colour) {
  std::vector<std::uint8_t> pixels;
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      for (const double share : colour((x + 0.5) / kSide, (y + 0.5) / kSide)) {
        pixels.push_back(static_cast<std::uint8_t>(std::lround(255 * share)));
      }
    }
  }
  return png_bytes(kSide, kSide, static_cast<std::uint32_t>(pixels.size() / kSide / kSide), pixels);
}

/// A normal texture of a field of round hills.
std::vector<std::uint8_t> hills();

/// Adds it to the document `root`, and its bytes to the binary buffer.
void add_image(Encoded& encoded, nlohmann::json& root, const std::string& name, const std::vector<std::uint8_t>& png);

}  // namespace lozenge::test_assets
