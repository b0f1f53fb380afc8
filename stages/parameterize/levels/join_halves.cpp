// A vertex goes where four triangles are left around it (two, on a boundary) that are two pairs of halves. Those around
// its neighbours become fewer by that, which come up for it again. What each triangle has cost in distortion before is
// summed up over what it was joined from, so that nothing creeps in from one join to the next.
#include "stages/parameterize/levels/join_halves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "formats/domain/distortion.h"
#include "formats/surface/attribute_streams.h"
#include "stages/parameterize/levels/split_long_edges.h"

namespace lozenge {

namespace {

LatticeArea squared_length(LatticePoint from, LatticePoint to) {
  const LatticeArea u = to.u - from.u;
  const LatticeArea v = to.v - from.v;
  return u * u + u * v + v * v;
}

LatticeArea doubled_area_of(const Development& image) {
  return doubled_area(image.corners[0], image.corners[1], image.corners[2]);
}

/// Two triangles (m, a, c) and (m, c, b) that are halves of (a, c, b), m the middle of the side from b to a.
struct Halves {
  std::array<TriangleId, 2> triangles{-1, -1};
  VertexId a = -1;
  VertexId c = -1;
  VertexId b = -1;
};

/// The triangle that halves were, and its image.
struct Whole {
  Development image;
  double distortion = 0;
};

class Joiner {
 public:
  Joiner(SourceMesh& mesh, Parameterization& map, const std::vector<char>& may_go, double most_worse)
      : mesh_(mesh),
        map_(map),
        may_go_(may_go),
        most_worse_(most_worse),
        around_(mesh.positions.size()),
        distortion_(mesh.triangles.size(), -1),
        gone_(mesh.triangles.size(), false),
        per_area_(surface_area(mesh.positions, mesh.triangles) / map.domain.size()) {
    for (TriangleId t = 0; t < static_cast<TriangleId>(mesh.triangles.size()); ++t) {
      for (const VertexId v : mesh.triangles[t]) {
        if (may_go[v]) around_[v].push_back(t);
      }
    }
  }

  std::int64_t run() {
    for (VertexId v = 0; v < static_cast<VertexId>(around_.size()); ++v) {
      if (may_go_[v]) waiting_.push_back(v);
    }
    std::int64_t joined = 0;
    for (; !waiting_.empty(); waiting_.pop_front()) joined += take_out(waiting_.front());
    if (joined > 0) leave_out();
    return joined;
  }

 private:
  int corner_of(TriangleId t, VertexId v) const {
    const auto& corners = mesh_.triangles[t];
    return static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
  }
  VertexId next_to(TriangleId t, VertexId v, int steps) const {
    return mesh_.triangles[t][(corner_of(t, v) + steps) % 3];
  }

  /// The triangles around a vertex counter-clockwise, where they are a fan or a whole turn.
  std::optional<std::vector<TriangleId>> fan_around(VertexId m) const {
    const std::vector<TriangleId>& all = around_[m];
    // The first of a fan is the one that no other comes before.
    TriangleId first = all.front();
    for (const TriangleId t : all) {
      const bool has_one_before = std::any_of(
          all.begin(), all.end(), [&](TriangleId other) { return next_to(other, m, 2) == next_to(t, m, 1); });
      if (!has_one_before) first = t;
    }
    std::vector<TriangleId> fan{first};
    while (fan.size() < all.size()) {
      const auto next = std::find_if(all.begin(), all.end(), [&](TriangleId other) {
        return next_to(other, m, 1) == next_to(fan.back(), m, 2);
      });
      if (next == all.end()) return std::nullopt;
      fan.push_back(*next);
    }
    return fan;
  }

  bool take_out(VertexId m) {
    const std::size_t count = around_[m].size();
    if (count != 2 && count != 4) return false;
    const auto fan = fan_around(m);
    if (!fan) return false;
    const bool is_inside = next_to(fan->front(), m, 1) == next_to(fan->back(), m, 2);
    if (is_inside != (count == 4)) return false;
    for (std::size_t turn = 0; turn < count / 2; ++turn) {
      std::vector<Halves> pairs;
      for (std::size_t i = 0; i < count; i += 2) {
        pairs.push_back(halves_of(m, (*fan)[(turn + i) % count], (*fan)[(turn + i + 1) % count]));
      }
      if (join(m, pairs)) return true;
    }
    return false;
  }

  Halves halves_of(VertexId m, TriangleId first, TriangleId second) const {
    return {{first, second}, next_to(first, m, 1), next_to(first, m, 2), next_to(second, m, 2)};
  }

  bool join(VertexId m, const std::vector<Halves>& pairs) {
    const Vec3f middle = middle_of_edge(mesh_.positions[pairs[0].a], mesh_.positions[pairs[0].b]);
    if (!(middle == mesh_.positions[m])) return false;
    std::vector<Whole> wholes;
    for (const Halves& halves : pairs) {
      auto whole = whole_of(m, halves);
      if (!whole) return false;
      wholes.push_back(*whole);
    }
    if (pairs.size() == 2 &&
        squared_length(wholes[0].image.corners[2], wholes[0].image.corners[0]) !=
            squared_length(wholes[1].image.corners[2], wholes[1].image.corners[0])) {
      return false;
    }
    if (!fill_the_place(pairs, wholes) || !is_worth_it(pairs, wholes)) return false;
    for (const Halves& halves : pairs) become_whole(m, halves);
    return true;
  }

  /// The triangle (a, c, b), where its image agrees with the halves' along the sides that stay.
  std::optional<Whole> whole_of(VertexId m, const Halves& halves) const {
    const auto& [first, second] = halves.triangles;
    if (!mesh_.materials.empty() && mesh_.materials[first] != mesh_.materials[second]) return std::nullopt;
    if (halves.a == halves.b || !are_halves_of_attributes(m, halves)) return std::nullopt;
    const auto image = develop(map_.domain, {map_.phi[halves.a], map_.phi[halves.c], map_.phi[halves.b]});
    if (!image || doubled_area_of(*image) <= 0) return std::nullopt;
    const auto of_first = image_of(mesh_, map_, first);
    const auto of_second = image_of(mesh_, map_, second);
    if (!of_first || !of_second) return std::nullopt;
    const int m1 = corner_of(first, m);
    const int m2 = corner_of(second, m);
    const auto& p = of_first->corners;
    const auto& q = of_second->corners;
    if (squared_length(image->corners[0], image->corners[1]) != squared_length(p[(m1 + 1) % 3], p[(m1 + 2) % 3]) ||
        squared_length(image->corners[1], image->corners[2]) != squared_length(q[(m2 + 1) % 3], q[(m2 + 2) % 3])) {
      return std::nullopt;
    }
    return Whole{*image, distortion_of({halves.a, halves.c, halves.b}, *image)};
  }

  /// Whether splitting the whole triangle would give the halves' corners, bit by bit.
  bool are_halves_of_attributes(VertexId m, const Halves& halves) const {
    const AttributeStreams& streams = mesh_.corner_attributes;
    if (streams.empty()) return true;
    const std::size_t first = 3 * static_cast<std::size_t>(halves.triangles[0]);
    const std::size_t second = 3 * static_cast<std::size_t>(halves.triangles[1]);
    const int m1 = corner_of(halves.triangles[0], m);
    const int m2 = corner_of(halves.triangles[1], m);
    AttributeStreams split = empty_like(streams);
    append_element(split, streams, first + (m1 + 1) % 3);   // a
    append_element(split, streams, first + (m1 + 2) % 3);   // c
    append_element(split, streams, second + (m2 + 2) % 3);  // b
    halve_triangle(split, 2);                               // (m, c, b), and (m, a, c)
    const std::array<std::size_t, 6> there{second + m2,           second + (m2 + 1) % 3, second + (m2 + 2) % 3,
                                           first + m1,            first + (m1 + 1) % 3,  first + (m1 + 2) % 3};
    for (std::size_t s = 0; s < streams.size(); ++s) {
      const auto width = static_cast<std::size_t>(streams[s].kind.components);
      for (std::size_t i = 0; i < there.size(); ++i) {
        const float* made = split[s].values.data() + i * width;
        if (!std::equal(made, made + width, streams[s].values.data() + there[i] * width)) return false;
      }
    }
    return true;
  }

  bool fill_the_place(const std::vector<Halves>& pairs, const std::vector<Whole>& wholes) const {
    LatticeArea excess = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      excess += doubled_area_of(wholes[i].image);
      for (const TriangleId t : pairs[i].triangles) excess -= doubled_area_of(*image_of(mesh_, map_, t));
    }
    return excess == 0;
  }

  bool is_worth_it(const std::vector<Halves>& pairs, const std::vector<Whole>& wholes) {
    double worse = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      worse += wholes[i].distortion;
      for (const TriangleId t : pairs[i].triangles) {
        worse -= distortion_before(t) + most_worse_ * triangle_area(mesh_.positions, mesh_.triangles[t]);
      }
    }
    return worse <= 0;
  }

  /// What a triangle adds to the distortion of areas three times, and to that of angles; times the surface's area.
  double distortion_of(const std::array<VertexId, 3>& corners, const Development& image) const {
    const double area = triangle_area(mesh_.positions, corners);
    if (!(area > 0)) return 0;
    const auto s = singular_values(
        {plane_point(image.corners[0]), plane_point(image.corners[1]), plane_point(image.corners[2])},
        {Vec3d(mesh_.positions[corners[0]]), Vec3d(mesh_.positions[corners[1]]), Vec3d(mesh_.positions[corners[2]])});
    const double image_area =
        static_cast<double>(doubled_area_of(image)) / static_cast<double>(kUnitTriangleDoubledArea) * per_area_;
    const double of_area = (area / image_area + image_area / area) / 2 - 1;
    const double of_angle = (s.s1 / s.s2 + s.s2 / s.s1) / 2 - 1;
    return area * (kAreaWeight * of_area + of_angle);
  }

  /// Before anything was joined, summed over what it was joined from.
  double distortion_before(TriangleId t) {
    if (distortion_[t] < 0) distortion_[t] = distortion_of(mesh_.triangles[t], *image_of(mesh_, map_, t));
    return distortion_[t];
  }

  void become_whole(VertexId m, const Halves& halves) {
    const auto& [kept, left_out] = halves.triangles;
    distortion_[kept] = distortion_before(kept) + distortion_before(left_out);
    // (m, a, c) gets b in the place of m.
    const int corner = corner_of(kept, m);
    const std::size_t from = 3 * static_cast<std::size_t>(left_out) + (corner_of(left_out, m) + 2) % 3;
    for (AttributeStream& stream : mesh_.corner_attributes) {
      const auto width = static_cast<std::size_t>(stream.kind.components);
      std::copy_n(stream.values.begin() + static_cast<std::ptrdiff_t>(from * width), width,
                  stream.values.begin() + static_cast<std::ptrdiff_t>((3 * kept + corner) * width));
    }
    mesh_.triangles[kept][corner] = halves.b;
    gone_[left_out] = true;
    std::erase(around_[halves.c], left_out);
    std::replace(around_[halves.b].begin(), around_[halves.b].end(), left_out, kept);
    around_[m].clear();
    for (const VertexId v : {halves.a, halves.c, halves.b}) {
      if (may_go_[v]) waiting_.push_back(v);
    }
  }

  void leave_out() {
    std::vector<bool> keep(gone_.size());
    std::size_t count = 0;
    for (std::size_t t = 0; t < gone_.size(); ++t) {
      keep[t] = !gone_[t];
      if (gone_[t]) continue;
      mesh_.triangles[count] = mesh_.triangles[t];
      if (!mesh_.materials.empty()) mesh_.materials[count] = mesh_.materials[t];
      ++count;
    }
    keep_triangles(mesh_.corner_attributes, keep);
    mesh_.triangles.resize(count);
    if (!mesh_.materials.empty()) mesh_.materials.resize(count);
  }

  SourceMesh& mesh_;
  Parameterization& map_;
  const std::vector<char>& may_go_;
  const double most_worse_;
  std::vector<std::vector<TriangleId>> around_;  ///< [vertex], of those that may go
  std::vector<double> distortion_;               ///< [triangle] as `distortion_before`, or -1 where it isn't known yet
  std::vector<char> gone_;                       ///< [triangle]
  std::deque<VertexId> waiting_;
  double per_area_ = 0;  ///< surface, for each domain triangle
};

}  // namespace

std::int64_t join_halves(SourceMesh& mesh, Parameterization& map, const std::vector<char>& may_go, double most_worse) {
  return Joiner(mesh, map, may_go, most_worse).run();
}

}  // namespace lozenge
