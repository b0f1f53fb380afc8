// Lines over an axis, as a picture: how distortion goes while the domain shrinks (paper, Fig. 5).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/render/picture.h"

namespace lozenge {

struct PlotLine {
  std::string label;
  Vec3f colour;  ///< linear
  std::vector<Vec2d> points;
};

struct Plot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool x_falls = false;  ///< large x at the left
  std::vector<PlotLine> lines;
};

Picture draw_plot(const Plot& plot, std::int32_t width, std::int32_t height);

/// Both plots of the paper's Fig. 5, side by side, from the trace that `parameterize --trace` writes.
/// \throws Error(kUnusableInput) where the file is no such trace
Picture render_trace(const std::filesystem::path& trace_json);

}  // namespace lozenge
