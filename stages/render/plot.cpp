// Axes from the range of the values to round numbers; lines and dots on a canvas.
#include "stages/render/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "formats/base/error.h"
#include "formats/domain/distortion.h"
#include "stages/render/canvas.h"

namespace lozenge {

namespace {

const Vec3f kPaper = srgb(0xFBFAF8);
const Vec3f kInk = srgb(0x22262B);
const Vec3f kPaleInk = srgb(0x6B7280);
const Vec3f kGrid = srgb(0xE4E3DF);

/// Round values for the marks of an axis: 1, 2 or 5 times a power of ten apart.
struct Axis {
  double low = 0;
  double high = 1;
  double step = 0.2;

  Axis(double from, double to, int marks) {
    if (!(to > from)) to = from + 1;
    const double rough = (to - from) / marks;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0}) {
      if (factor * power >= rough) step = factor * power;
    }
    low = std::floor(from / step + 1e-9) * step;
    high = std::ceil(to / step - 1e-9) * step;
  }
  int marks() const { return static_cast<int>(std::lround((high - low) / step)); }
  double mark(int i) const { return low + i * step; }
};

std::string label_of(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", std::abs(value) < step * 1e-6 ? 0.0 : value, std::min(decimals, 9));
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  bool empty() const { return low > high; }
};

/// One plot being drawn.
class Sheet {
 public:
  Sheet(const Plot& plot, std::int32_t width, std::int32_t height)
      : plot_(plot),
        picture_(width, height, kPaper),
        unit_(std::max(std::min(width, height) / 48.0, 6.0)),
        left_(6.5 * unit_),
        right_(width - 2 * unit_),
        top_(4.2 * unit_),
        bottom_(height - 5.2 * unit_),
        x_(axis(true, 6)),
        y_(axis(false, 5)) {}

  Picture draw() {
    draw_grid();
    for (const PlotLine& line : plot_.lines) draw_line(line);
    draw_legend();
    draw_text(picture_, plot_.title, {left_, 2.3 * unit_}, 1.05 * unit_, kInk, Align::kLeft, true);
    draw_text(picture_, plot_.x_label, {(left_ + right_) / 2, picture_.height - 1.3 * unit_}, 0.8 * unit_, kInk,
              Align::kCentre);
    draw_text_upwards(picture_, plot_.y_label, {1.9 * unit_, (top_ + bottom_) / 2}, 0.8 * unit_, kInk);
    return std::move(picture_);
  }

 private:
  Axis axis(bool horizontal, int marks) const {
    Range range;
    if (!horizontal) range.add(0);
    for (const PlotLine& line : plot_.lines) {
      for (const Vec2d& p : line.points) range.add(horizontal ? p.x : p.y);
    }
    return range.empty() ? Axis(0, 1, marks) : Axis(range.low, range.high, marks);
  }

  Vec2d place(const Vec2d& p) const {
    double s = (p.x - x_.low) / (x_.high - x_.low);
    if (plot_.x_falls) s = 1 - s;
    return {left_ + s * (right_ - left_), bottom_ - (p.y - y_.low) / (y_.high - y_.low) * (bottom_ - top_)};
  }

  void draw_grid() {
    for (int i = 0; i <= y_.marks(); ++i) {
      const double y = place({x_.low, y_.mark(i)}).y;
      draw_polyline(picture_, {{left_, y}, {right_, y}}, i == 0 ? 1.4 : 1, i == 0 ? kPaleInk : kGrid);
      draw_text(picture_, label_of(y_.mark(i), y_.step), {left_ - 0.7 * unit_, y + 0.32 * unit_}, 0.68 * unit_,
                kPaleInk, Align::kRight);
    }
    for (int i = 0; i <= x_.marks(); ++i) {
      const double x = place({x_.mark(i), y_.low}).x;
      draw_polyline(picture_, {{x, bottom_}, {x, bottom_ + 0.4 * unit_}}, 1.2, kPaleInk);
      draw_text(picture_, label_of(x_.mark(i), x_.step), {x, bottom_ + 1.6 * unit_}, 0.68 * unit_, kPaleInk,
                Align::kCentre);
    }
  }

  void draw_line(const PlotLine& line) {
    std::vector<Vec2d> points;
    for (const Vec2d& p : line.points) {
      if (std::isfinite(p.x) && std::isfinite(p.y)) points.push_back(place(p));
    }
    draw_polyline(picture_, points, std::max(0.16 * unit_, 1.5), line.colour);
  }

  void draw_legend() {
    double x = right_;
    for (auto line = plot_.lines.rbegin(); line != plot_.lines.rend(); ++line) {
      if (line->label.empty()) continue;
      x -= text_width(line->label, 0.75 * unit_);
      draw_text(picture_, line->label, {x, 2.3 * unit_}, 0.75 * unit_, kInk);
      draw_polyline(picture_, {{x - 2.2 * unit_, 1.95 * unit_}, {x - 0.7 * unit_, 1.95 * unit_}}, 0.25 * unit_,
                    line->colour);
      x -= 3.6 * unit_;
    }
  }

  const Plot& plot_;
  Picture picture_;
  double unit_, left_, right_, top_, bottom_;
  Axis x_, y_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw Error(ExitCode::kUnusableInput,
              fmt::format("{}: {}; give a trace that `lozenge parameterize` wrote", path.filename().string(), what));
}

nlohmann::json read_rows(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) refuse(path, "it cannot be opened");
  nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (json.is_object() && json.contains("trace")) json = json["trace"];
  if (!json.is_array() || json.empty()) refuse(path, "it holds no rows of a trace");
  return json;
}

double number(const std::filesystem::path& path, const nlohmann::json& row, const char* key, std::size_t index) {
  if (!row.is_object() || !row.contains(key) || !row[key].is_number()) {
    refuse(path, fmt::format("row {} has no number \"{}\"", index, key));
  }
  return row[key].get<double>();
}

}  // namespace

Picture draw_plot(const Plot& plot, std::int32_t width, std::int32_t height) {
  return Sheet(plot, width, height).draw();
}

Picture render_trace(const std::filesystem::path& trace_json) {
  const nlohmann::json rows = read_rows(trace_json);
  PlotLine area{"area", srgb(0xC8442F), {}};
  PlotLine angle{"angle", srgb(0x2E8B57), {}};
  PlotLine aggregate{"aggregate", srgb(0x2F5FB3), {}};
  PlotLine weighed{"", srgb(0x2F5FB3), {}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto value = [&](const char* key) { return number(trace_json, rows[i], key, i); };
    const double faces = value("domain_faces");
    area.points.emplace_back(faces, 100 * value("area"));
    angle.points.emplace_back(faces, 100 * value("angle"));
    aggregate.points.emplace_back(faces, 100 * value("aggregate"));
    weighed.points.emplace_back(faces, weighed_by_size(value("aggregate"), faces));
  }
  constexpr std::int32_t kWidth = 900;
  constexpr std::int32_t kHeight = 640;
  const Plot left{"Distortion", "triangles of the domain", "in hundredths", true, {angle, area, aggregate}};
  const Plot right{"Best size of the domain", "triangles of the domain", "aggregate x sqrt(|D|)", true, {weighed}};
  Picture both(2 * kWidth, kHeight, kPaper);
  paste(both, draw_plot(left, kWidth, kHeight), 0, 0);
  paste(both, draw_plot(right, kWidth, kHeight), kWidth, 0);
  return both;
}

}  // namespace lozenge
