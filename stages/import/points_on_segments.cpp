// The box of the points is halved across its longest side, and each half shrunk to the points in it: so every cut parts
// points, and those that are the same end in a box without extent. A segment goes into a half whose box it runs through
// (slab test).
#include "stages/import/points_on_segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace lozenge {

namespace {

/// So few points are looked at one by one.
constexpr std::size_t kFew = 8;

struct Box {
  Vec3d low{std::numeric_limits<double>::max()};
  Vec3d high{std::numeric_limits<double>::lowest()};

  void add(const Vec3d& p) {
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  int longest_side() const {
    const Vec3d size = high - low;
    const int first = size.x >= size.y ? 0 : 1;
    return size[first] >= size.z ? first : 2;
  }
};

bool runs_through(const Segment& segment, const Box& box) {
  double enters = 0;
  double leaves = 1;
  for (int i = 0; i < 3; ++i) {
    const double low = box.low[i] - segment.tolerance;
    const double high = box.high[i] + segment.tolerance;
    const double start = segment.start[i];
    const double way = segment.end[i] - start;
    if (way == 0) {
      if (start < low || start > high) return false;
      continue;
    }
    const double first = (low - start) / way;
    const double second = (high - start) / way;
    enters = std::max(enters, std::min(first, second));
    leaves = std::min(leaves, std::max(first, second));
  }
  return enters <= leaves;
}

struct Search {
  const std::vector<Segment>& segments;
  const std::vector<Vec3d>& points;
  const std::function<bool(std::int32_t, std::int32_t)>& found;

  bool run(const std::vector<std::int32_t>& those_above, std::span<std::int32_t> inside) const {
    if (inside.empty()) return true;
    Box box;
    for (const std::int32_t p : inside) box.add(points[p]);
    std::vector<std::int32_t> here;
    for (const std::int32_t s : those_above) {
      if (runs_through(segments[s], box)) here.push_back(s);
    }
    if (here.empty()) return true;
    const int side = box.longest_side();
    const double middle = (box.low[side] + box.high[side]) / 2;
    const auto cut =
        std::partition(inside.begin(), inside.end(), [&](std::int32_t p) { return points[p][side] <= middle; });
    const auto left = static_cast<std::size_t>(cut - inside.begin());
    if (inside.size() <= kFew || left == 0 || left == inside.size()) {
      for (const std::int32_t s : here) {
        for (const std::int32_t p : inside) {
          if (!found(s, p)) return false;
        }
      }
      return true;
    }
    return run(here, inside.first(left)) && run(here, inside.subspan(left));
  }
};

}  // namespace

double share_on_segment(const Segment& segment, const Vec3d& point) {
  const Vec3d way = segment.end - segment.start;
  const double length = way.length();
  if (!(length > 0)) return -1;
  const double share = (point - segment.start).dot(way) / (length * length);
  if (!(share * length > segment.tolerance && (1 - share) * length > segment.tolerance)) return -1;
  return (segment.start + way * share - point).length() <= segment.tolerance ? share : -1;
}

bool for_each_point_near_segments(const std::vector<Segment>& segments, const std::vector<Vec3d>& points,
                                  const std::function<bool(std::int32_t, std::int32_t)>& found) {
  std::vector<std::int32_t> all_segments(segments.size());
  std::vector<std::int32_t> all_points(points.size());
  std::iota(all_segments.begin(), all_segments.end(), 0);
  std::iota(all_points.begin(), all_points.end(), 0);
  return Search{segments, points, found}.run(all_segments, all_points);
}

}  // namespace lozenge
