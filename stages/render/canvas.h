// Flat drawing: smooth lines, rectangles, and a small typeface of strokes, so that no font needs to be installed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "stages/render/picture.h"

namespace lozenge {

/// A line through all the points, with round ends and joints; coordinates in pixels from the top left corner.
void draw_polyline(Picture& picture, const std::vector<Vec2d>& points, double width, const Vec3f& colour,
                   double opacity = 1);

/// From (x, y) to (x + width, y + height), in whole pixels; what lies outside the picture is left out.
void fill_rectangle(Picture& picture, std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height,
                    const Vec3f& colour);

/// Copies `source` with its top left corner at (x, y).
void paste(Picture& picture, const Picture& source, std::int32_t x, std::int32_t y);

enum class Align { kLeft, kCentre, kRight };

/// Text on a baseline at `y`; capitals are `height` pixels high. Characters outside of ASCII become '?'.
void draw_text(Picture& picture, std::string_view text, Vec2d at, double height, const Vec3f& colour,
               Align align = Align::kLeft, bool bold = false);

/// The same, turned by a quarter to read upwards.
void draw_text_upwards(Picture& picture, std::string_view text, Vec2d at, double height, const Vec3f& colour,
                       Align align = Align::kCentre);

/// In pixels.
double text_width(std::string_view text, double height);

}  // namespace lozenge
