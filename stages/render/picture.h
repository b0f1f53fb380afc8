// A picture in memory, and its PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// Linear RGB, 0..1, row by row from the top.
struct Picture {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<Vec3f> pixels;

  Picture() = default;
  Picture(std::int32_t w, std::int32_t h, Vec3f colour)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, colour) {}
  Vec3f& at(std::int32_t x, std::int32_t y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Vec3f& at(std::int32_t x, std::int32_t y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

/// The linear colour of an sRGB one given as 0xRRGGBB.
Vec3f srgb(std::uint32_t hex);

/// Writes an 8 bit sRGB PNG; whole or not at all, the same bytes for the same picture.
/// \throws Error where the file cannot be written
void write_picture(const std::filesystem::path& path, const Picture& picture);

}  // namespace lozenge
