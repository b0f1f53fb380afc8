// A vertex goes by moving it along an edge into the vertex at the edge's other end. That leaves the surface what it was
// where each triangle that stays has that end in its plane, and none turns over. What was left out so far is kept for
// each triangle, so that any further step can be asked how far all of that moves in the atlas.
#include "formats/patches/leave_out_flat_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "formats/base/parallel.h"
#include "formats/patches/patch_border.h"
#include "formats/patches/vertex_fan.h"

namespace lozenge {

namespace {

/// What is so near to a border lies on it, in sides of a patch.
constexpr double kOnBorder = 1e-6;

/// A place that was a corner of triangles, and lies within one now.
struct LeftOut {
  Vec3f position;
  std::int32_t patch = -1;
  std::int32_t group = -1;
  Vec2d place;
  Vec3f carried;
};

/// A way to leave a vertex out.
struct Plan {
  std::vector<std::int32_t> changed;           ///< triangles that stay
  std::vector<ChartedTriangle> triangles;      ///< what they become
  std::vector<std::vector<LeftOut>> left_out;  ///< [changed] what lies in each then
  double roundness = 0;                        ///< of the worst of them
};

/// Twice the area of a triangle in the plane of a unit normal, positive where it is counter-clockwise seen from there.
double area_along(const Vec3d& normal, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return normal.dot((b - a).cross(c - a));
}

/// How far the coordinates there are from numbers that floats can hold, and from the planes that they were rounded off.
double rounding_at(const Vec3f& p) {
  constexpr double kRoundings = 4.0 / (1 << 23);
  return kRoundings * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

class Flattener {
 public:
  Flattener(ChartedSurface& surface, const std::vector<ChartScale>& charts,
            const std::vector<std::array<PatchSide, 4>>& adjacency, const FlatVertexOptions& options)
      : surface_(surface),
        charts_(charts),
        adjacency_(adjacency),
        options_(options),
        around_(surface),
        left_out_(surface.triangles.size()) {}

  std::int64_t run() {
    std::vector<VertexId> open = flat_vertices();
    std::vector<bool> is_open(surface_.positions.size(), false);
    is_candidate_.assign(surface_.positions.size(), 0);
    for (const VertexId v : open) {
      is_open[v] = true;
      is_candidate_[v] = 1;
    }
    std::int64_t count = 0;
    for (std::size_t next = 0; next < open.size(); ++next) {
      const VertexId v = open[next];
      is_open[v] = false;
      const auto fan = fan_of(surface_, around_, v);
      if (!fan || !leave_out(*fan)) continue;
      ++count;
      is_candidate_[v] = 0;
      // What was in the way of a neighbour may be gone.
      for (const VertexId rim : fan->rim) {
        if (is_candidate_[rim] != 0 && !is_open[rim]) {
          is_open[rim] = true;
          open.push_back(rim);
        }
      }
    }
    std::erase_if(surface_.triangles, [](const ChartedTriangle& t) { return t.patch < 0; });
    return count;
  }

 private:
  const Vec3f& position(VertexId v) const { return surface_.positions[v]; }
  Vec3d exact(VertexId v) const { return Vec3d(surface_.positions[v]); }

  // ---- Which vertices may be left out at all

  /// Those around which the surface is bent along two edges at most.
  std::vector<VertexId> flat_vertices() const {
    std::vector<char> flat(surface_.positions.size(), 0);
    for_each_part(flat.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) flat[v] = is_flat(static_cast<VertexId>(v)) ? 1 : 0;
    });
    std::vector<VertexId> found;
    for (std::size_t v = 0; v < flat.size(); ++v) {
      if (flat[v] != 0) found.push_back(static_cast<VertexId>(v));
    }
    return found;
  }

  bool is_flat(VertexId v) const {
    // More than two planes through a point have no line in common: all but two directions of normals are none.
    std::array<Vec3f, 2> normals;
    int planes = 0;
    constexpr float kSame = 1e-4F;  // of small triangles, rounding turns the planes by more than one wants
    for (const std::int32_t t : around_[v]) {
      const Vec3f& n = surface_.triangles[t].normal;
      bool known = false;
      for (int p = 0; p < planes; ++p) known = known || (n - normals[p]).length2() < kSame;
      if (known) continue;
      if (planes == 2) return false;
      normals[planes++] = n;
    }
    return planes > 0;
  }

  // ---- Leaving one out

  bool leave_out(const VertexFan& fan) {
    std::optional<Plan> best;
    for (int i = 0; i < static_cast<int>(fan.rim.size()); ++i) {
      std::optional<Plan> plan = plan_along(fan, i);
      if (plan && (!best || plan->roundness > best->roundness)) best = std::move(plan);
    }
    if (!best) return false;
    carry_out(fan, std::move(*best));
    return true;
  }

  void carry_out(const VertexFan& fan, Plan plan) {
    std::vector<VertexId> touched = fan.rim;
    for (const std::int32_t t : fan.triangles) {
      surface_.triangles[t].patch = -1;
      left_out_[t].clear();
    }
    for (std::size_t n = 0; n < plan.changed.size(); ++n) {
      surface_.triangles[plan.changed[n]] = plan.triangles[n];
      left_out_[plan.changed[n]] = std::move(plan.left_out[n]);
    }
    // The end's new triangles are among the changed ones; the others of the rim lose what is gone.
    for (const VertexId rim : touched) {
      std::vector<std::int32_t> kept;
      for (const std::int32_t t : around_[rim]) {
        if (surface_.triangles[t].patch >= 0) kept.push_back(t);
      }
      for (std::size_t n = 0; n < plan.changed.size(); ++n) {
        const auto& corners = plan.triangles[n].corners;
        const bool has = std::any_of(corners.begin(), corners.end(), [&](const auto& c) { return c.vertex == rim; });
        if (has && std::find(kept.begin(), kept.end(), plan.changed[n]) == kept.end()) kept.push_back(plan.changed[n]);
      }
      around_.replace(rim, std::move(kept));
    }
    around_.replace(fan.vertex, {});
  }

  /// Into rim[i].
  std::optional<Plan> plan_along(const VertexFan& fan, int i) const {
    const int n = fan.size();
    const int left = fan.closed || i < n ? i : -1;                    // the triangle left of the edge, or none
    const int right = i > 0 ? i - 1 : (fan.closed ? n - 1 : -1);      // the one right of it
    if (!fan.closed && left >= 0 && right >= 0) return std::nullopt;  // off the surface's end
    if (n < (fan.closed ? 3 : 2)) return std::nullopt;
    const auto stays = [&](int j) { return j != left && j != right; };
    const VertexId end = fan.rim[i];
    if (!keeps_planes(fan, end, stays)) return std::nullopt;
    if (!fan.closed && !keeps_boundary(fan, i)) return std::nullopt;
    if (!keeps_topology(fan, i)) return std::nullopt;
    const auto corners = corners_at_end(fan, i, left, right);
    if (!corners) return std::nullopt;
    return with_places(fan, stays, *corners);
  }

  template <typename Stays>
  bool keeps_planes(const VertexFan& fan, VertexId end, const Stays& stays) const {
    const Vec3d v = exact(fan.vertex);
    const Vec3d w = exact(end);
    const double off = std::max(rounding_at(position(fan.vertex)), rounding_at(position(end)));
    for (int j = 0; j < fan.size(); ++j) {
      if (!stays(j)) continue;
      const Vec3d normal(surface_.triangles[fan.triangles[j]].normal);
      if (!(normal.length2() > 0) || std::abs(normal.dot(w - v)) > off) return false;
      if (!(area_along(normal, w, exact(fan.rim[j]), exact(fan.end_of(j))) > 0)) return false;
    }
    return true;
  }

  /// The vertex lies on the line between its neighbours on the surface's boundary, but for rounding.
  bool keeps_boundary(const VertexFan& fan, int i) const {
    const Vec3d w = exact(fan.rim[i]);
    const Vec3d other = exact(i == 0 ? fan.rim.back() : fan.rim.front());
    const Vec3d v = exact(fan.vertex);
    const Vec3d along = other - w;
    if (!(along.length2() > 0) || (v - w).dot(v - other) > 0) return false;
    return along.cross(v - w).length() <= rounding_at(position(fan.vertex)) * along.length();
  }

  /// The two have no neighbours in common but those across from their edge.
  bool keeps_topology(const VertexFan& fan, int i) const {
    const auto size = static_cast<int>(fan.rim.size());
    const VertexId end = fan.rim[i];
    const VertexId next = fan.closed || i + 1 < size ? fan.rim[(i + 1) % size] : -1;
    const VertexId previous = fan.closed || i > 0 ? fan.rim[(i + size - 1) % size] : -1;
    for (const std::int32_t t : around_[end]) {
      for (const ChartedCorner& corner : surface_.triangles[t].corners) {
        const VertexId u = corner.vertex;
        if (u == end || u == fan.vertex || u == next || u == previous) continue;
        if (std::find(fan.rim.begin(), fan.rim.end(), u) != fan.rim.end()) return false;
      }
    }
    return true;
  }

  // ---- What the end is called in each triangle that stays

  const ChartedCorner& own(const VertexFan& fan, int j) const {
    return surface_.triangles[fan.triangles[j]].corners[fan.corner[j]];
  }
  const ChartedTriangle& triangle(const VertexFan& fan, int j) const { return surface_.triangles[fan.triangles[j]]; }

  bool goes_on(const VertexFan& fan, int j, int k) const {
    return triangle(fan, j).patch == triangle(fan, k).patch && own(fan, j).place == own(fan, k).place;
  }
  bool carries_on(const VertexFan& fan, int j, int k) const {
    return triangle(fan, j).group == triangle(fan, k).group && own(fan, j).carried == own(fan, k).carried;
  }

  /// [triangle of the fan] the end's corner in it. Places and what is carried are those that the two triangles at the
  /// edge have there, as far around as nothing breaks; beyond a border that the edge leaves behind, the place is that
  /// in the gutter.
  std::optional<std::vector<ChartedCorner>> corners_at_end(const VertexFan& fan, int i, int left, int right) const {
    const int n = fan.size();
    const VertexId end = fan.rim[i];
    std::vector<ChartedCorner> corners(static_cast<std::size_t>(n), ChartedCorner{end, Vec2d(0, 0), Vec3f(0, 0, 0)});
    std::vector<char> placed(static_cast<std::size_t>(n), 0);
    std::vector<char> carried(static_cast<std::size_t>(n), 0);
    // From the triangle at the edge around the fan; `step` 1 is counter-clockwise.
    const auto spread = [&](int from, int step) {
      if (from < 0) return true;
      const ChartedTriangle& start = triangle(fan, from);
      const ChartedCorner& there = start.corners[corner_with(start, end)];
      bool places = true;
      bool carries = true;
      for (int count = 0, j = from; count < n && (places || carries); ++count) {
        if (places) {
          if (placed[j] != 0 && !(corners[j].place == there.place)) return false;
          corners[j].place = there.place;
          placed[j] = 1;
        }
        if (carries) {
          if (carried[j] != 0 && !(corners[j].carried == there.carried)) return false;
          corners[j].carried = there.carried;
          carried[j] = 1;
        }
        int next = j + step;
        if (fan.closed) next = (next + n) % n;
        else if (next < 0 || next >= n) break;
        // The way around ends at the other triangle of the edge.
        if (next == (step > 0 ? right : left)) break;
        places = places && goes_on(fan, j, next);
        carries = carries && carries_on(fan, j, next);
        j = next;
      }
      return true;
    };
    if (!spread(left, 1) || !spread(right, -1)) return std::nullopt;
    for (int j = 0; j < n; ++j) {
      if (j == left || j == right) continue;
      if (carried[j] == 0) return std::nullopt;
    }
    if (!place_in_gutters(fan, i, left, right, placed, corners)) return std::nullopt;
    return corners;
  }

  /// Places for the triangles beyond the one border that runs through the vertex, where the edge leaves it behind.
  bool place_in_gutters(const VertexFan& fan, int i, int left, int right, const std::vector<char>& placed,
                        std::vector<ChartedCorner>& corners) const {
    const int n = fan.size();
    int beyond = -1;
    for (int j = 0; j < n; ++j) {
      if (j == left || j == right || placed[j] != 0) continue;
      if (beyond >= 0 && !goes_on(fan, beyond, j)) return false;
      beyond = j;
    }
    if (beyond < 0) return true;
    if (left < 0 || right < 0 || !goes_on(fan, left, right)) return false;
    const std::int32_t here = triangle(fan, left).patch;
    // The end lies inside of its patch, all around.
    for (const std::int32_t t : around_[fan.rim[i]]) {
      if (surface_.triangles[t].patch != here) return false;
    }
    const Vec2d end = corners[left].place;
    const auto side = common_side(here, own(fan, left).place, triangle(fan, beyond).patch, own(fan, beyond).place);
    if (!side || !within_reach(here, *side, end) || !is_between_neighbours(fan, here, *side, end)) return false;
    const Vec2d place = across_border(*side, end, adjacency_[here][*side].side);
    for (int j = 0; j < n; ++j) {
      if (j != left && j != right && placed[j] == 0) corners[j].place = place;
    }
    return true;
  }

  /// The side of `patch` across which the other one calls the place `there`.
  std::optional<int> common_side(std::int32_t patch, const Vec2d& place, std::int32_t other, const Vec2d& there) const {
    for (int side = 0; side < 4 && !adjacency_.empty(); ++side) {
      const PatchSide across = adjacency_[patch][side];
      if (across.patch != other) continue;
      if ((across_border(side, place, across.side) - there).length() < kOnBorder) return side;
    }
    return std::nullopt;
  }

  double texels_per_side(std::int32_t patch) const { return charts_[patch].texels; }

  /// Whether the neighbour's gutter holds the place, and whatever is filtered around it.
  bool within_reach(std::int32_t patch, int side, const Vec2d& place) const {
    constexpr double kFilter = 0.5;    // texels: as far as bilinear filtering looks
    constexpr double kNothing = 0.01;  // texels, that show without a gutter as well
    const BorderPlace seen = seen_from_side(side, place);
    const double reach = std::max(kNothing, charts_[patch].gutter - kFilter) / texels_per_side(patch);
    return seen.depth <= reach && seen.along > 0 && seen.along < 1;
  }

  /// Borders don't turn back: along the side, the end comes between the neighbours of the vertex on the border.
  bool is_between_neighbours(const VertexFan& fan, std::int32_t patch, int side, const Vec2d& end) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int j = 0; j < fan.size(); ++j) {
      const ChartedTriangle& t = triangle(fan, j);
      if (t.patch != patch) continue;
      const int next = (j + 1) % fan.size();
      const int previous = (j + fan.size() - 1) % fan.size();
      const auto along = [&](int corner) { return seen_from_side(side, t.corners[corner % 3].place).along; };
      if (!goes_on(fan, j, previous)) {
        low = std::min(low, along(fan.corner[j] + 1));
        high = std::max(high, along(fan.corner[j] + 1));
      }
      if (!goes_on(fan, j, next)) {
        low = std::min(low, along(fan.corner[j] + 2));
        high = std::max(high, along(fan.corner[j] + 2));
      }
    }
    const double along = seen_from_side(side, end).along;
    return low < along && along < high;
  }

  // ---- Where all lies afterwards

  template <typename Stays>
  std::optional<Plan> with_places(const VertexFan& fan, const Stays& stays,
                                  const std::vector<ChartedCorner>& corners) const {
    Plan plan;
    plan.roundness = std::numeric_limits<double>::infinity();
    for (int j = 0; j < fan.size(); ++j) {
      if (!stays(j)) continue;
      ChartedTriangle t = triangle(fan, j);
      t.corners[fan.corner[j]] = corners[j];
      const double round = roundness_in_atlas(t);
      if (!(round > 0)) return std::nullopt;
      plan.roundness = std::min(plan.roundness, round);
      plan.changed.push_back(fan.triangles[j]);
      plan.triangles.push_back(t);
    }
    plan.left_out.resize(plan.changed.size());
    for (int j = 0; j < fan.size(); ++j) {
      for (const LeftOut& known : left_out_[fan.triangles[j]]) {
        if (!put(known, plan)) return std::nullopt;
      }
    }
    for (int j = 0; j < fan.size(); ++j) {
      const int previous = j > 0 ? j - 1 : (fan.closed ? fan.size() - 1 : -1);
      if (previous >= 0 && previous != j && goes_on(fan, previous, j) && carries_on(fan, previous, j)) continue;
      if (!put(left_out_of(fan, j), plan)) return std::nullopt;
    }
    // Where nothing breaks all around, no triangle came first.
    const bool unbroken = fan.closed && [&] {
      for (int j = 0; j < fan.size(); ++j) {
        const int next = (j + 1) % fan.size();
        if (!goes_on(fan, j, next) || !carries_on(fan, j, next)) return false;
      }
      return true;
    }();
    if (unbroken && !put(left_out_of(fan, 0), plan)) return std::nullopt;
    return plan;
  }

  LeftOut left_out_of(const VertexFan& fan, int j) const {
    const ChartedTriangle& t = triangle(fan, j);
    return {position(fan.vertex), t.patch, t.group, own(fan, j).place, own(fan, j).carried};
  }

  /// Positive where the triangle is one in the atlas, even when its coordinates are rounded: by its area and its
  /// longest side's square.
  double roundness_in_atlas(const ChartedTriangle& t) const {
    constexpr double kLeastHeight = 1e-3;  // texels: ten roundings of a float in an atlas of 2048 texels
    const double scale = texels_per_side(t.patch);
    const Vec2d a = t.corners[0].place;
    const Vec2d b = t.corners[1].place - a;
    const Vec2d c = t.corners[2].place - a;
    const double longest = std::max({b.length2(), c.length2(), (c - b).length2()});
    const double area = b.cross(c);
    return longest > 0 && area * scale > kLeastHeight * std::sqrt(longest) ? area / longest : 0;
  }

  /// Puts a place into the triangle that holds it. \return false where none does that leaves it about where it was
  bool put(const LeftOut& place, Plan& plan) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t n = 0; n < plan.triangles.size(); ++n) {
      const ChartedTriangle& t = plan.triangles[n];
      if (t.group != place.group) continue;
      const auto weights = weights_in(t, place.position);
      if (!weights) continue;
      const double moved = moved_by(t, *weights, place) / most_moved(t);
      if (moved < least && carries_about(t, *weights, place)) {
        least = moved;
        best = n;
      }
    }
    if (!(least <= 1)) return false;
    plan.left_out[best].push_back(place);
    return true;
  }

  /// Where a point lies in a triangle, nothing where it doesn't.
  std::optional<Vec3d> weights_in(const ChartedTriangle& t, const Vec3f& point) const {
    constexpr double kSlack = 1e-3;
    const Vec3d normal(t.normal);
    const Vec3d p(point);
    const std::array<Vec3d, 3> corners{exact(t.corners[0].vertex), exact(t.corners[1].vertex),
                                       exact(t.corners[2].vertex)};
    const double off = 2 * std::max(rounding_at(point), rounding_at(position(t.corners[0].vertex)));
    if (std::abs(normal.dot(p - corners[0])) > off) return std::nullopt;
    const double area = area_along(normal, corners[0], corners[1], corners[2]);
    Vec3d weights;
    for (int c = 0; c < 3; ++c) {
      weights[c] = area_along(normal, p, corners[(c + 1) % 3], corners[(c + 2) % 3]) / area;
      if (!(weights[c] >= -kSlack)) return std::nullopt;
    }
    return weights;
  }

  /// In texels.
  double most_moved(const ChartedTriangle& t) const {
    double longest = 0;
    for (int c = 0; c < 3; ++c) {
      longest = std::max(longest, (t.corners[c].place - t.corners[(c + 1) % 3].place).length());
    }
    return std::max(options_.most_texels, options_.most_of_side * longest * texels_per_side(t.patch));
  }

  /// In texels.
  double moved_by(const ChartedTriangle& t, const Vec3d& weights, const LeftOut& place) const {
    Vec2d now(0, 0);
    for (int c = 0; c < 3; ++c) now += t.corners[c].place * weights[c];
    const double scale = texels_per_side(t.patch);
    if (t.patch == place.patch) return (now - place.place).length() * scale;
    double least = std::numeric_limits<double>::infinity();
    for (int side = 0; side < 4 && !adjacency_.empty(); ++side) {
      const PatchSide across = adjacency_[place.patch][side];
      if (across.patch != t.patch || !within_reach(place.patch, side, place.place)) continue;
      least = std::min(least, (across_border(side, place.place, across.side) - now).length() * scale);
    }
    return least;
  }

  bool carries_about(const ChartedTriangle& t, const Vec3d& weights, const LeftOut& place) const {
    Vec3d now(0, 0, 0);
    for (int c = 0; c < 3; ++c) now += Vec3d(t.corners[c].carried) * weights[c];
    if (options_.carries_directions) {
      const double length = now.length();
      if (!(length > 0)) return false;
      now /= length;
    }
    return (now - Vec3d(place.carried)).length() <= options_.most_carried;
  }

  ChartedSurface& surface_;
  const std::vector<ChartScale>& charts_;
  const std::vector<std::array<PatchSide, 4>>& adjacency_;
  const FlatVertexOptions& options_;
  TrianglesAround around_;
  std::vector<std::vector<LeftOut>> left_out_;  ///< [triangle] what lies in it and was left out
  std::vector<char> is_candidate_;
};

}  // namespace

std::vector<ChartScale> chart_scales(const MapLayout& layout, std::int32_t patches) {
  std::vector<ChartScale> charts;
  for (std::int32_t patch = 0; patch < patches; ++patch) {
    const MapTile tile = layout.tile_of(patch);
    charts.push_back({static_cast<double>(tile.inner() - 1), static_cast<double>(tile.gutter)});
  }
  return charts;
}

std::int64_t leave_out_flat_vertices(ChartedSurface& surface, const std::vector<ChartScale>& charts,
                                     const std::vector<std::array<PatchSide, 4>>& adjacency,
                                     const FlatVertexOptions& options) {
  return Flattener(surface, charts, adjacency, options).run();
}

}  // namespace lozenge
