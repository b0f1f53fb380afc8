// Strokes are distances: a pixel is covered as far as its middle is inside the pen's width. Text is strokes, too
// (glyphs.h).
#include "stages/render/canvas.h"

#include <algorithm>
#include <cmath>

#include "stages/render/glyphs.h"

namespace lozenge {

namespace {

double distance_to_segment(const Vec2d& p, const Vec2d& a, const Vec2d& b) {
  const Vec2d e = b - a;
  const double squared = e.dot(e);
  const double s = squared > 0 ? std::clamp((p - a).dot(e) / squared, 0.0, 1.0) : 0.0;
  return (p - (a + e * s)).length();
}

/// How much of each pixel the strokes cover; joints count once.
class Coverage {
 public:
  Coverage(const Picture& picture, const std::vector<std::vector<Vec2d>>& strokes, double width)
      : picture_width_(picture.width), picture_height_(picture.height), reach_(width / 2 + 0.5) {
    find_box(strokes);
    if (empty()) return;
    cover_.assign(static_cast<std::size_t>(x1_ - x0_) * (y1_ - y0_), 0.0F);
    for (const auto& stroke : strokes) {
      for (std::size_t i = 0; i + 1 < stroke.size(); ++i) add(stroke[i], stroke[i + 1]);
      if (stroke.size() == 1) add(stroke[0], stroke[0]);
    }
  }

  void paint(Picture& picture, const Vec3f& colour, double opacity) const {
    for (std::int32_t y = y0_; y < y1_ && !empty(); ++y) {
      for (std::int32_t x = x0_; x < x1_; ++x) {
        const auto a = static_cast<float>(cover_[at(x, y)] * opacity);
        if (a > 0) picture.at(x, y) = picture.at(x, y) * (1 - a) + colour * a;
      }
    }
  }

 private:
  bool empty() const { return x0_ >= x1_ || y0_ >= y1_; }
  std::size_t at(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y - y0_) * (x1_ - x0_) + (x - x0_);
  }

  struct Box {
    std::int32_t x0, y0, x1, y1;
  };
  Box box_of(const Vec2d& a, const Vec2d& b) const {
    const auto low = [&](double p, double q) {
      return static_cast<std::int32_t>(std::floor(std::min(p, q) - reach_ - 1));
    };
    const auto high = [&](double p, double q) {
      return static_cast<std::int32_t>(std::ceil(std::max(p, q) + reach_ + 1));
    };
    return {std::max(low(a.x, b.x), 0), std::max(low(a.y, b.y), 0), std::min(high(a.x, b.x), picture_width_),
            std::min(high(a.y, b.y), picture_height_)};
  }

  void find_box(const std::vector<std::vector<Vec2d>>& strokes) {
    x0_ = picture_width_;
    y0_ = picture_height_;
    for (const auto& stroke : strokes) {
      for (const Vec2d& p : stroke) {
        const Box box = box_of(p, p);
        x0_ = std::min(x0_, box.x0);
        y0_ = std::min(y0_, box.y0);
        x1_ = std::max(x1_, box.x1);
        y1_ = std::max(y1_, box.y1);
      }
    }
  }

  void add(const Vec2d& a, const Vec2d& b) {
    const Box box = box_of(a, b);
    for (std::int32_t y = box.y0; y < box.y1; ++y) {
      for (std::int32_t x = box.x0; x < box.x1; ++x) {
        const double cover = std::clamp(reach_ - distance_to_segment({x + 0.5, y + 0.5}, a, b), 0.0, 1.0);
        float& here = cover_[at(x, y)];
        here = std::max(here, static_cast<float>(cover));
      }
    }
  }

  std::int32_t picture_width_, picture_height_;
  double reach_;
  std::int32_t x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  std::vector<float> cover_;
};

void draw_glyphs(Picture& picture, std::string_view text, Vec2d at, double height, const Vec3f& colour, double start,
                 bool upwards, bool bold) {
  const double unit = height / kCapitalHeight;
  std::vector<std::vector<Vec2d>> strokes;
  double x = start;
  for (const char c : text) {
    const Glyph& glyph = glyph_of(c);
    for (const auto& source : glyph.strokes) {
      std::vector<Vec2d>& stroke = strokes.emplace_back();
      for (const Vec2d& p : source) {
        const double along = x + p.x * unit;
        const double up = p.y * unit;
        stroke.push_back(upwards ? Vec2d(at.x - up, at.y - along) : Vec2d(at.x + along, at.y - up));
      }
    }
    x += (glyph.width + kLetterGap) * unit;
  }
  const double thickness = std::max((bold ? 1.15 : 0.78) * unit, 0.9);
  Coverage(picture, strokes, thickness).paint(picture, colour, 1);
}

double start_of(std::string_view text, double height, Align align) {
  if (align == Align::kLeft) return 0;
  return -text_width(text, height) * (align == Align::kCentre ? 0.5 : 1);
}

}  // namespace

void draw_polyline(Picture& picture, const std::vector<Vec2d>& points, double width, const Vec3f& colour,
                   double opacity) {
  Coverage(picture, {points}, width).paint(picture, colour, opacity);
}

void fill_rectangle(Picture& picture, std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height,
                    const Vec3f& colour) {
  for (std::int32_t j = std::max(y, 0); j < std::min(y + height, picture.height); ++j) {
    for (std::int32_t i = std::max(x, 0); i < std::min(x + width, picture.width); ++i) picture.at(i, j) = colour;
  }
}

void paste(Picture& picture, const Picture& source, std::int32_t x, std::int32_t y) {
  for (std::int32_t j = std::max(0, -y); j < std::min(source.height, picture.height - y); ++j) {
    for (std::int32_t i = std::max(0, -x); i < std::min(source.width, picture.width - x); ++i) {
      picture.at(x + i, y + j) = source.at(i, j);
    }
  }
}

void draw_text(Picture& picture, std::string_view text, Vec2d at, double height, const Vec3f& colour, Align align,
               bool bold) {
  draw_glyphs(picture, text, at, height, colour, start_of(text, height, align), false, bold);
}

void draw_text_upwards(Picture& picture, std::string_view text, Vec2d at, double height, const Vec3f& colour,
                       Align align) {
  draw_glyphs(picture, text, at, height, colour, start_of(text, height, align), true, false);
}

double text_width(std::string_view text, double height) {
  double width = 0;
  for (const char c : text) width += glyph_of(c).width + kLetterGap;
  return text.empty() ? 0 : (width - kLetterGap) * height / kCapitalHeight;
}

}  // namespace lozenge
