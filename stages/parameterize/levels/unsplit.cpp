// A vertex that was put into an edge sees the pieces of two of the numbered triangles (one, on a boundary), and goes
// along that edge; one inside of a triangle sees its pieces alone. What around it can go when it has gone is looked at
// again.
#include "stages/parameterize/levels/unsplit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>

#include "formats/domain/distortion.h"
#include "formats/surface/attribute_streams.h"

namespace lozenge {

namespace {

/// The number of the triangle that a piece is of: below 2^24, floats are exact.
constexpr AttributeKind kNumbers{.semantic = "_LOZENGE_TRIANGLE",
                                 .label = "triangle numbers",
                                 .components = 1,
                                 .interpolation = Interpolation::kNearest};
constexpr std::size_t kMostNumbers = std::size_t{1} << 24;

LatticeArea squared_length(LatticePoint from, LatticePoint to) {
  const LatticeArea u = to.u - from.u;
  const LatticeArea v = to.v - from.v;
  return u * u + u * v + v * v;
}

LatticeArea doubled_area_of(const Development& image) {
  return doubled_area(image.corners[0], image.corners[1], image.corners[2]);
}

/// A vertex with what is around it, counter-clockwise: triangle i lies between vertices i and i + 1.
struct Ring {
  std::vector<TriangleId> triangles;
  std::vector<VertexId> vertices;  ///< as many, or one more at the end of a boundary's fan
  bool is_closed = false;

  std::size_t size() const { return triangles.size(); }
};

/// The triangles that are left when a vertex collapses into another one: those around it that don't touch that, with
/// it in the vertex's place.
struct Collapse {
  std::size_t target = 0;         ///< index in the ring's vertices
  std::vector<std::size_t> left;  ///< indices in the ring's triangles
  std::vector<double> distortions;
  double distortion = 0;
};

class Unsplitter {
 public:
  Unsplitter(SourceMesh& mesh, Parameterization& map, const std::vector<char>& may_go, double most_worse)
      : mesh_(mesh),
        map_(map),
        may_go_(may_go),
        most_worse_(most_worse),
        number_(mesh.triangles.size()),
        around_(mesh.positions.size()),
        distortion_(mesh.triangles.size(), -1),
        gone_(mesh.triangles.size(), 0),
        per_area_(surface_area(mesh.positions, mesh.triangles) / map.domain.size()) {
    const AttributeStream& numbers = *find_stream(mesh.corner_attributes, kNumbers);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      number_[t] = static_cast<std::int32_t>(numbers.values[3 * t]);
      for (const VertexId v : mesh.triangles[t]) around_[v].push_back(static_cast<TriangleId>(t));
    }
  }

  std::int64_t run() {
    for (VertexId v = 0; v < static_cast<VertexId>(around_.size()); ++v) {
      if (may_go_[v]) waiting_.push_back(v);
    }
    std::int64_t taken = 0;
    for (; !waiting_.empty(); waiting_.pop_front()) taken += take_out(waiting_.front());
    if (taken > 0) leave_out();
    return taken;
  }

 private:
  // ---- What is around a vertex

  int corner_of(TriangleId t, VertexId v) const {
    const auto& corners = mesh_.triangles[t];
    return static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
  }
  VertexId after(TriangleId t, VertexId v) const { return mesh_.triangles[t][(corner_of(t, v) + 1) % 3]; }
  VertexId before(TriangleId t, VertexId v) const { return mesh_.triangles[t][(corner_of(t, v) + 2) % 3]; }

  /// Nothing where they are no fan.
  std::optional<Ring> ring_of(VertexId v) const {
    const std::vector<TriangleId>& all = around_[v];
    if (all.empty()) return std::nullopt;
    Ring ring;
    TriangleId first = all.front();
    for (const TriangleId t : all) {
      const bool has_one_before =
          std::any_of(all.begin(), all.end(), [&](TriangleId other) { return before(other, v) == after(t, v); });
      if (!has_one_before) first = t;
    }
    ring.triangles.push_back(first);
    while (ring.size() < all.size()) {
      const VertexId from = before(ring.triangles.back(), v);
      const auto next = std::find_if(all.begin(), all.end(), [&](TriangleId t) { return after(t, v) == from; });
      if (next == all.end()) return std::nullopt;
      ring.triangles.push_back(*next);
    }
    for (const TriangleId t : ring.triangles) ring.vertices.push_back(after(t, v));
    const VertexId end = before(ring.triangles.back(), v);
    ring.is_closed = end == ring.vertices.front();
    if (!ring.is_closed) ring.vertices.push_back(end);
    return ring;
  }

  /// Whether the edge from the ring's middle to this vertex of it lies on an edge that was split.
  bool is_on_edge(const Ring& ring, std::size_t i) const {
    if (!ring.is_closed) return i == 0 || i == ring.size();
    return number_[ring.triangles[i]] != number_[ring.triangles[(i + ring.size() - 1) % ring.size()]];
  }

  /// Where the ring's middle may go without the surface changing.
  std::vector<std::size_t> targets_in(const Ring& ring) const {
    std::vector<std::size_t> on_edge;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
      all.push_back(i);
      if (is_on_edge(ring, i)) on_edge.push_back(i);
    }
    if (on_edge.empty()) return all;
    if (on_edge.size() != 2) return {};
    return on_edge;
  }

  // ---- Whether it may go

  bool take_out(VertexId v) {
    const auto ring = ring_of(v);
    if (!ring) return false;
    std::optional<Collapse> best;
    for (const std::size_t target : targets_in(*ring)) {
      auto collapse = collapse_into(v, *ring, target);
      if (collapse && (!best || collapse->distortion < best->distortion)) best = std::move(collapse);
    }
    if (!best || best->distortion > distortion_in(*ring) + most_worse_) return false;
    carry_out(v, *ring, *best);
    return true;
  }

  /// Nothing where the surface would not stay what it is, or the map not exact.
  std::optional<Collapse> collapse_into(VertexId v, const Ring& ring, std::size_t target) const {
    Collapse collapse{target, {}, {}, 0};
    const VertexId into = ring.vertices[target];
    for (std::size_t step = 0; step < ring.size(); ++step) {
      const std::size_t i = (target + step) % ring.size();
      if (corner_of(ring.triangles[i], into) == 3) collapse.left.push_back(i);
    }
    const std::size_t expected = ring.size() - (ring.is_closed ? 2 : 1);
    if (collapse.left.empty() || collapse.left.size() != expected || makes_second_edge(ring, collapse, into)) {
      return std::nullopt;
    }
    if (!keeps_the_surface(v, into, ring, collapse) || !keeps_the_map(v, into, ring, collapse)) return std::nullopt;
    return collapse;
  }

  /// Whether an edge to one of the ring's inner vertices is there already.
  bool makes_second_edge(const Ring& ring, const Collapse& collapse, VertexId into) const {
    for (std::size_t k = 1; k < collapse.left.size(); ++k) {
      const VertexId inner = ring.vertices[collapse.left[k]];
      const auto& all = around_[inner];
      if (std::any_of(all.begin(), all.end(), [&](TriangleId t) { return corner_of(t, into) < 3; })) return true;
    }
    return false;
  }

  std::array<VertexId, 3> with(TriangleId t, VertexId v, VertexId into) const {
    std::array<VertexId, 3> corners = mesh_.triangles[t];
    corners[corner_of(t, v)] = into;
    return corners;
  }

  Vec3d normal_of(const std::array<VertexId, 3>& corners) const {
    const Vec3d a(mesh_.positions[corners[0]]);
    return (Vec3d(mesh_.positions[corners[1]]) - a).cross(Vec3d(mesh_.positions[corners[2]]) - a);
  }

  /// Height by length of a triangle.
  double width_of(const std::array<VertexId, 3>& corners) const {
    double longest = 0;
    for (int c = 0; c < 3; ++c) {
      longest = std::max(longest,
                         (Vec3d(mesh_.positions[corners[(c + 1) % 3]]) - Vec3d(mesh_.positions[corners[c]])).length2());
    }
    return longest > 0 ? normal_of(corners).length() / longest : 0;
  }

  /// No piece is turned over, or much thinner than those that were there.
  bool keeps_the_surface(VertexId v, VertexId into, const Ring& ring, const Collapse& collapse) const {
    constexpr double kThin = 0.05;
    constexpr double kThinner = 0.25;
    double thinnest = 1;
    for (const TriangleId t : ring.triangles) thinnest = std::min(thinnest, width_of(mesh_.triangles[t]));
    const double least = std::min(kThin, kThinner * thinnest);
    return std::all_of(collapse.left.begin(), collapse.left.end(), [&](std::size_t i) {
      const TriangleId t = ring.triangles[i];
      const auto corners = with(t, v, into);
      return normal_of(corners).dot(normal_of(mesh_.triangles[t])) > 0 && width_of(corners) >= least;
    });
  }

  /// The images fit what is around the ring and each other, and fill its place. Fills in distortions.
  bool keeps_the_map(VertexId v, VertexId into, const Ring& ring, Collapse& collapse) const {
    LatticeArea excess = 0;
    LatticeArea last = -1;  // squared length of the side that the next triangle has, too
    for (std::size_t i = 0; i < ring.size(); ++i) excess -= doubled_area_of(*image_of(mesh_, map_, ring.triangles[i]));
    for (std::size_t k = 0; k < collapse.left.size(); ++k) {
      const TriangleId t = ring.triangles[collapse.left[k]];
      const auto corners = with(t, v, into);
      const auto image = develop(map_.domain, {map_.phi[corners[0]], map_.phi[corners[1]], map_.phi[corners[2]]});
      if (!image || doubled_area_of(*image) <= 0) return false;
      excess += doubled_area_of(*image);
      const int c = corner_of(t, v);
      const auto side = [&](const Development& d, int from, int to) {
        return squared_length(d.corners[(c + from) % 3], d.corners[(c + to) % 3]);
      };
      if (side(*image, 1, 2) != side(*image_of(mesh_, map_, t), 1, 2)) return false;
      if (k == 0) last = length_on_ring(ring, into, mesh_.triangles[t][(c + 1) % 3]);
      if (last >= 0 && side(*image, 0, 1) != last) return false;
      last = side(*image, 2, 0);
      if (k + 1 == collapse.left.size()) {
        const LatticeArea there = length_on_ring(ring, into, mesh_.triangles[t][(c + 2) % 3]);
        if (there >= 0 && last != there) return false;
      }
      collapse.distortions.push_back(distortion_of(corners, *image));
      collapse.distortion += collapse.distortions.back();
    }
    return excess == 0;
  }

  /// Squared length of the image of an edge of the ring's rim; -1 where it has none between these.
  LatticeArea length_on_ring(const Ring& ring, VertexId a, VertexId b) const {
    for (const TriangleId t : ring.triangles) {
      const int ca = corner_of(t, a);
      const int cb = corner_of(t, b);
      if (ca == 3 || cb == 3) continue;
      const auto image = image_of(mesh_, map_, t);
      return squared_length(image->corners[ca], image->corners[cb]);
    }
    return -1;
  }

  // ---- What it costs

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

  double distortion_in(const Ring& ring) {
    double sum = 0;
    for (const TriangleId t : ring.triangles) {
      if (distortion_[t] < 0) distortion_[t] = distortion_of(mesh_.triangles[t], *image_of(mesh_, map_, t));
      sum += distortion_[t];
    }
    return sum;
  }

  // ---- Taking it out

  void carry_out(VertexId v, const Ring& ring, const Collapse& collapse) {
    const VertexId into = ring.vertices[collapse.target];
    for (std::size_t k = 0; k < collapse.left.size(); ++k) {
      const TriangleId t = ring.triangles[collapse.left[k]];
      take_corner(t, corner_of(t, v), into, ring);
      mesh_.triangles[t] = with(t, v, into);
      around_[into].push_back(t);
      distortion_[t] = collapse.distortions[k];
    }
    for (const TriangleId t : ring.triangles) {
      if (corner_of(t, v) == 3) continue;
      gone_[t] = 1;
      for (const VertexId w : mesh_.triangles[t]) {
        if (w != v) std::erase(around_[w], t);
      }
    }
    around_[v].clear();
    for (const VertexId w : ring.vertices) {
      if (may_go_[w]) waiting_.push_back(w);
    }
  }

  /// Another piece of the same triangle has the attributes of that corner: the one that goes, and has it.
  void take_corner(TriangleId t, int corner, VertexId into, const Ring& ring) {
    for (const TriangleId other : ring.triangles) {
      const int from = corner_of(other, into);
      if (other == t || number_[other] != number_[t] || from == 3) continue;
      for (AttributeStream& stream : mesh_.corner_attributes) {
        const auto width = static_cast<std::size_t>(stream.kind.components);
        const auto at = [&](TriangleId triangle, int c) {
          return stream.values.begin() +
                 static_cast<std::ptrdiff_t>((3 * static_cast<std::size_t>(triangle) + c) * width);
        };
        std::copy_n(at(other, from), width, at(t, corner));
      }
      return;
    }
  }

  void leave_out() {
    std::vector<bool> keep(gone_.size());
    std::size_t count = 0;
    for (std::size_t t = 0; t < gone_.size(); ++t) {
      keep[t] = gone_[t] == 0;
      if (!keep[t]) continue;
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
  std::vector<std::int32_t> number_;             ///< [triangle]
  std::vector<std::vector<TriangleId>> around_;  ///< [vertex]
  std::vector<double> distortion_;               ///< [triangle] or -1 where it isn't known yet
  std::vector<char> gone_;                       ///< [triangle]
  std::deque<VertexId> waiting_;
  double per_area_ = 0;  ///< surface, for each domain triangle
};

}  // namespace

void number_triangles(SourceMesh& mesh) {
  if (mesh.triangles.size() > kMostNumbers) return;
  AttributeStream& numbers = stream_for(mesh.corner_attributes, kNumbers);
  numbers.values.resize(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < numbers.values.size(); ++i) numbers.values[i] = static_cast<float>(i / 3);
}

void forget_numbers(SourceMesh& mesh) {
  std::erase_if(mesh.corner_attributes, [](const AttributeStream& stream) { return stream.kind == kNumbers; });
}

std::int64_t take_out_splits(SourceMesh& mesh, Parameterization& map, const std::vector<char>& may_go,
                             double most_worse) {
  if (!find_stream(mesh.corner_attributes, kNumbers)) return 0;
  return Unsplitter(mesh, map, may_go, most_worse).run();
}

}  // namespace lozenge
