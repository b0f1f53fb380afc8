// Triangles hang together where two have an edge of equal positions; charts where its texture coordinates are equal,
// too. What overlaps is found by drawing all triangles into a picture of the atlas.
#include "formats/surface/uv_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>

#include "formats/base/disjoint_sets.h"

namespace lozenge {

namespace {

using Place = std::array<std::uint32_t, 3>;

Place place_of(const Vec3f& p) {
  return {std::bit_cast<std::uint32_t>(p.x + 0.0F), std::bit_cast<std::uint32_t>(p.y + 0.0F),
          std::bit_cast<std::uint32_t>(p.z + 0.0F)};
}

struct PlaceHash {
  std::size_t operator()(const Place& p) const {
    std::size_t hash = 0xcbf29ce484222325U;
    for (const std::uint32_t word : p) hash = (hash ^ word) * 0x100000001b3U;
    return hash ^ (hash >> 31);
  }
};

/// [vertex] one number for all at a place.
std::vector<std::uint32_t> welded(const std::vector<Vec3f>& positions) {
  std::unordered_map<Place, std::uint32_t, PlaceHash> known;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(positions.size());
  for (const Vec3f& p : positions) {
    numbers.push_back(known.try_emplace(place_of(p), static_cast<std::uint32_t>(known.size())).first->second);
  }
  return numbers;
}

class Measurement {
 public:
  Measurement(const UvSurface& surface, std::int32_t size)
      : surface_(surface), size_(size), charts_(surface.triangles.size()) {}

  UvStatistics run() {
    measure_triangles();
    find_seams();
    draw();
    return result_;
  }

 private:
  Vec2d uv(std::size_t t, int c) const { return Vec2d(surface_.uvs[surface_.triangles[t][c]]); }
  Vec3d position(std::size_t t, int c) const { return Vec3d(surface_.positions[surface_.triangles[t][c]]); }

  void measure_triangles() {
    // Rounding of coordinates near 1.
    constexpr double kRounding = 1.0 / (1 << 23);
    double squares = 0;
    double covered = 0;
    for (const Vec2f& p : surface_.uvs) result_.outside += !(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1);
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      const Vec2d b = uv(t, 1) - uv(t, 0);
      const Vec2d c = uv(t, 2) - uv(t, 0);
      const double cross = b.cross(c);
      const double longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
      const Vec3d e = position(t, 1) - position(t, 0);
      const Vec3d f = position(t, 2) - position(t, 0);
      const double area = e.cross(f).length() / 2;
      result_.area += area;
      covered += std::abs(cross) / 2;
      signs_[cross > 0] += std::abs(cross);
      folds_[cross > 0] += std::abs(cross) > kRounding * longest;
      if (!(std::abs(cross) > 0)) continue;
      // Of the linear map from the atlas to the surface, half the sum of its squared singular values.
      const Vec3d along_u = (e * c.y - f * b.y) / cross;
      const Vec3d along_v = (f * b.x - e * c.x) / cross;
      squares += area * (along_u.length2() + along_v.length2()) / 2;
    }
    // Whichever way most of the atlas faces is the right one.
    result_.folded = folds_[signs_[1] >= signs_[0] ? 0 : 1];
    result_.atlas_share = covered;
    result_.l2_stretch = result_.area > 0 ? std::sqrt(squares / result_.area * covered / result_.area) : 1;
  }

  void find_seams() {
    const std::vector<std::uint32_t> number = welded(surface_.positions);
    struct Side {
      std::size_t triangle;
      int corner;
    };
    std::map<std::array<std::uint32_t, 2>, std::vector<Side>> sides;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        std::array<std::uint32_t, 2> ends{number[surface_.triangles[t][c]], number[surface_.triangles[t][(c + 1) % 3]]};
        if (ends[0] == ends[1]) continue;
        if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
        sides[ends].push_back({t, c});
      }
    }
    for (const auto& [ends, all] : sides) {
      const std::uint32_t start = ends[0];
      for (std::size_t n = 1; n < all.size(); ++n) {
        const auto ends_in_atlas = [&](const Side& side) {
          const std::array<Vec2d, 2> found{uv(side.triangle, side.corner), uv(side.triangle, (side.corner + 1) % 3)};
          const bool forward = number[surface_.triangles[side.triangle][side.corner]] == start;
          return forward ? found : std::array<Vec2d, 2>{found[1], found[0]};
        };
        // Of sheets that lie on each other, any two may go on into each other.
        std::size_t other = 0;
        while (other < n && !(ends_in_atlas(all[other]) == ends_in_atlas(all[n]))) ++other;
        if (other < n) {
          charts_.join(static_cast<std::int32_t>(all[other].triangle), static_cast<std::int32_t>(all[n].triangle));
        } else {
          const auto& [t, c] = all[n];
          result_.seam_length += (position(t, c) - position(t, (c + 1) % 3)).length();
        }
      }
    }
    join_at_vertices(number);
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      result_.charts += charts_.root(static_cast<std::int32_t>(t)) == static_cast<std::int32_t>(t);
    }
  }

  /// What touches in a vertex, in the atlas as on the surface, is one chart, too.
  void join_at_vertices(const std::vector<std::uint32_t>& number) {
    std::map<std::tuple<std::uint32_t, float, float>, std::int32_t> first;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (const std::uint32_t v : surface_.triangles[t]) {
        const Vec2f& at = surface_.uvs[v];
        const auto [known, is_new] = first.try_emplace({number[v], at.x, at.y}, static_cast<std::int32_t>(t));
        if (!is_new) charts_.join(known->second, static_cast<std::int32_t>(t));
      }
    }
  }

  void draw() {
    const auto side = static_cast<std::size_t>(size_);
    std::vector<std::int32_t> picture(side * side, -1);
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) draw(t, picture);
    result_.least_gap = kMostGap;
    for (std::int32_t y = 0; y < size_; ++y) {
      for (std::int32_t x = 0; x < size_; ++x) measure_gap(picture, x, y);
    }
  }

  void draw(std::size_t t, std::vector<std::int32_t>& picture) {
    constexpr double kRounding = 1e-3;  // texels: of coordinates that are floats
    std::array<Vec2d, 3> p;
    for (int c = 0; c < 3; ++c) p[c] = uv(t, c) * static_cast<double>(size_) - Vec2d(0.5, 0.5);
    const double cross = (p[1] - p[0]).cross(p[2] - p[0]);
    if (cross == 0) return;
    if (cross < 0) std::swap(p[1], p[2]);
    const auto low = [&](double a, double b, double c) {
      return std::max<std::int32_t>(0, static_cast<std::int32_t>(std::ceil(std::min({a, b, c}))));
    };
    const auto high = [&](double a, double b, double c) {
      return std::min<std::int32_t>(size_ - 1, static_cast<std::int32_t>(std::floor(std::max({a, b, c}))));
    };
    const std::int32_t chart = charts_.root(static_cast<std::int32_t>(t));
    for (std::int32_t y = low(p[0].y, p[1].y, p[2].y); y <= high(p[0].y, p[1].y, p[2].y); ++y) {
      for (std::int32_t x = low(p[0].x, p[1].x, p[2].x); x <= high(p[0].x, p[1].x, p[2].x); ++x) {
        const Vec2d q(x, y);
        double inside = std::numeric_limits<double>::infinity();
        for (int c = 0; c < 3; ++c) {
          const Vec2d along = p[(c + 1) % 3] - p[c];
          inside = std::min(inside, along.cross(q - p[c]) / along.length());
        }
        if (!(inside > kRounding)) continue;
        std::int32_t& texel = picture[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + x];
        if (texel >= 0) ++result_.overlapping_texels;
        texel = chart;
      }
    }
  }

  void measure_gap(const std::vector<std::int32_t>& picture, std::int32_t x, std::int32_t y) {
    const auto at = [&](std::int32_t i, std::int32_t j) {
      return picture[static_cast<std::size_t>(j) * static_cast<std::size_t>(size_) + i];
    };
    const std::int32_t here = at(x, y);
    if (here < 0) return;
    for (std::int32_t gap = 0; gap < result_.least_gap; ++gap) {
      const bool right = x + gap + 1 < size_ && at(x + gap + 1, y) >= 0 && at(x + gap + 1, y) != here;
      const bool below = y + gap + 1 < size_ && at(x, y + gap + 1) >= 0 && at(x, y + gap + 1) != here;
      if (right || below) result_.least_gap = gap;
    }
  }

  static constexpr std::int32_t kMostGap = 16;

  const UvSurface& surface_;
  std::int32_t size_;
  DisjointSets<std::int32_t> charts_;
  UvStatistics result_;
  std::array<double, 2> signs_{};
  std::array<std::int64_t, 2> folds_{};
};

}  // namespace

UvStatistics uv_statistics(const UvSurface& surface, std::int32_t size) { return Measurement(surface, size).run(); }

}  // namespace lozenge
