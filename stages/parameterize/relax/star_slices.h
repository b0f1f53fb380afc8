// A star's polygon cut into slices that meet in another point than its middle.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "stages/parameterize/map/plane_motion.h"
#include "stages/parameterize/relax/star_polygon.h"

namespace lozenge {

/// The polygon's slices when they meet in another centre.
class StarSlices {
 public:
  StarSlices(const StarPolygon& polygon, const Vec2d& centre) : centre_(centre) {
    for (int i = 0; i < polygon.slices; ++i) {
      const Vec2d a = polygon.corner(i) - centre;
      const Vec2d b = polygon.corner(i + 1) - centre;
      slices_.push_back({a, b, 1 / cross(a, b)});
    }
  }

  /// Where a point of the diameter lies: on the first side that leaves the centre, or on the last.
  StarSlice find_on_diameter(const Vec2d& p) const {
    const double x = p.x - centre_.x;
    if (x >= 0) return {0, std::min(x / slices_.front().first.x, 1.0), 0};
    return {static_cast<int>(slices_.size()) - 1, 0, std::min(x / slices_.back().second.x, 1.0)};
  }

  /// Where a point of the polygon lies.
  StarSlice find(const Vec2d& p) const {
    return find_in(p, [](int) { return true; });
  }

  /// Where a point of the polygon's rim lies that the surface's boundary runs through: on one of the rim's sides that
  /// have no neighbour. \return nothing where there is no such side
  template <typename HasNeighbour>
  std::optional<StarSlice> find_on_rim(const Vec2d& p, const HasNeighbour& has_neighbour) const {
    StarSlice w = find_in(p, [&](int slice) { return !has_neighbour(slice); });
    if (has_neighbour(w.slice)) return std::nullopt;
    const double sum = w.first + w.second;
    if (!(sum > 0)) return std::nullopt;
    w.first /= sum;
    w.second /= sum;
    return w;
  }

 private:
  /// Of some slices, where the point lies, or lies beside.
  template <typename IsWanted>
  StarSlice find_in(const Vec2d& p, const IsWanted& is_wanted) const {
    StarSlice best;
    double least = -std::numeric_limits<double>::infinity();
    const Vec2d q = p - centre_;
    for (std::size_t i = 0; i < slices_.size() && least < 0; ++i) {
      const Slice& s = slices_[i];
      if (!is_wanted(static_cast<int>(i))) continue;
      const StarSlice here{static_cast<int>(i), cross(q, s.second) * s.inverse_area,
                           cross(s.first, q) * s.inverse_area};
      const double inside = std::min(here.first, here.second);
      if (inside > least) {
        least = inside;
        best = here;
      }
    }
    // Rounding may put a point a hair outside.
    best.first = std::max(best.first, 0.0);
    best.second = std::max(best.second, 0.0);
    if (const double sum = best.first + best.second; sum > 1) {
      best.first /= sum;
      best.second /= sum;
    }
    return best;
  }

  struct Slice {
    Vec2d first, second;  ///< corners, from the centre
    double inverse_area;
  };
  Vec2d centre_;
  std::vector<Slice> slices_;
};

}  // namespace lozenge
