#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "formats/error.h"
#include "stages/parameterize/global_optimization.h"
#include "stages/parameterize/levels.h"
#include "stages/parameterize/local_optimization.h"

namespace lozenge {

namespace {

/// The hole that a removed vertex left, laid out flat: the triangles that close it all meet in one vertex u, and are
/// unfolded around it one after the other.
struct Hole {
  std::vector<Vec2d> outline;  ///< u, then the other corners counter-clockwise
  struct Slice {
    FlatImage image;  ///< in a frame of its own, turned so that u comes first
    Vec2d turn;       ///< the rotation (cosine, sine) from there into the layout, about u
  };
  std::vector<Slice> slices;  ///< slice i lies between outline corners i + 1 and i + 2

  const Vec2d& centre() const { return outline.front(); }
};

Vec2d times(const Vec2d& a, const Vec2d& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
Vec2d conjugate(const Vec2d& a) { return {a.x, -a.y}; }

/// Lays out the triangles around the start of `first`, from there counter-clockwise to `last`, which both leave it.
/// \return nothing where one of them has no flat image
std::optional<Hole> lay_out(const WorkingMap& map, Halfedge first, Halfedge last) {
  const HalfedgeMesh& mesh = map.mesh;
  Hole hole;
  for (Halfedge out = first;; out = mesh.next_around(out)) {
    auto image = flat_image(map, out / 3);
    if (!image) return std::nullopt;
    std::rotate(image->at.begin(), image->at.begin() + out % 3, image->at.end());
    Vec2d turn(1, 0);
    if (hole.outline.empty()) {
      hole.outline = {image->at[0], image->at[1]};
    } else {
      // Turned about u so that the shared edge falls on itself.
      turn = times(hole.outline.back() - hole.centre(), conjugate(image->at[1] - image->at[0]));
      const double length = turn.length();
      if (!(length > 0)) return std::nullopt;
      turn /= length;
    }
    hole.outline.push_back(hole.centre() + times(turn, image->at[2] - image->at[0]));
    hole.slices.push_back({*image, turn});
    if (out == last) break;
  }
  return hole;
}

/// The smallest doubled area of the triangles between a point and the sides of an outline, relative to the squared
/// size.
double smallest_area(const std::vector<Vec2d>& outline, const Vec2d& x) {
  double least = 1e300;
  double size = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2d& p = outline[i];
    const Vec2d& q = outline[i + 1 == outline.size() ? 0 : i + 1];
    least = std::min(least, cross(p - x, q - x));
    size = std::max(size, (p - x).length2());
  }
  return least / size;
}

/// The ring's mean with the weights that the vertex has in space (mean value coordinates, which are positive).
Vec2d mean_value_point(const WorkingMap& map, VertexId v, const std::vector<VertexId>& ring,
                       const std::vector<Vec2d>& outline) {
  const Vec3d centre((*map.positions)[v]);
  const std::size_t n = ring.size();
  std::vector<double> half_tangent(n);
  const auto direction = [&](std::size_t i) { return Vec3d((*map.positions)[ring[i % n]]) - centre; };
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3d p = direction(i), q = direction(i + 1);
    // tan(angle / 2) = sin / (1 + cos)
    const double lengths = p.length() * q.length();
    const double down = lengths + p.dot(q);
    half_tangent[i] = down > 1e-12 * lengths ? p.cross(q).length() / down : 0;
  }
  Vec2d sum(0, 0);
  double total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double length = direction(i).length();
    if (!(length > 0)) continue;
    const double weight = (half_tangent[i] + half_tangent[(i + n - 1) % n]) / length;
    sum += outline[i] * weight;
    total += weight;
  }
  return total > 0 ? sum / total : outline[0];
}

class Refinement {
 public:
  explicit Refinement(WorkingMap& map) : map_(map) {}

  /// \return false, with the vertex still removed, where it finds no place
  bool put_back(const Removal& removal) {
    const VertexId v = removal.vertex;
    const Halfedge h_left = map_.mesh.twins[previous_in_triangle(removal.halfedge)];
    const Halfedge h_right = next_in_triangle(map_.mesh.twins[next_in_triangle(map_.mesh.twins[removal.halfedge])]);
    const auto hole = lay_out(map_, h_left, h_right);
    const auto rest = lay_out(map_, map_.mesh.next_around(h_right), previous_around(h_left));
    if (!hole) return false;
    undo_removal(map_.mesh, removal);
    if (!settle(v, *hole) && !(rest && take_over(v, map_.mesh.end(removal.halfedge), *rest))) return false;
    for_each_outgoing(map_.mesh, v, [&](Halfedge h) {
      map_.rest[h / 3] = rest_shape(*map_.positions, map_.mesh.triangles[h / 3], map_.surface_area);
    });
    relax_vertex(map_, v, scratch_);
    return true;
  }

 private:
  /// Tries the place that the vertex has in space, the middle of what the whole hole is seen from, and points ever
  /// nearer to the vertex that closed it, half-way between its two neighbours on the outline.
  bool settle(VertexId v, const Hole& hole) {
    constexpr double kSafe = 1e-3;
    ring_.clear();
    for_each_outgoing(map_.mesh, v, [&](Halfedge h) { ring_.push_back(map_.mesh.end(h)); });
    const Vec2d mean = mean_value_point(map_, v, ring_, hole.outline);
    if (smallest_area(hole.outline, mean) > kSafe && put_at(v, hole, mean)) return true;
    if (const auto middle = point_of_kernel(hole.outline)) {
      if (put_at(v, hole, *middle)) return true;
      // Around a cone of few triangles a neighbour may be seen the wrong way from the middle, and rightly from
      // elsewhere.
      const std::vector<Vec2d> kernel = kernel_of(hole.outline);
      for (const double outward : {0.4, 0.7, 0.9}) {
        for (const Vec2d& corner : kernel) {
          if (put_at(v, hole, *middle * (1 - outward) + corner * outward)) return true;
        }
      }
    }
    const Vec2d ahead = direction_into(hole);
    for (double step = 0.25; step > 1e-6; step /= 2) {
      if (put_at(v, hole, hole.centre() + ahead * step)) return true;
    }
    return false;
  }

  /// Around a cone of more than a full turn a hole may be too wide for any point to see all of it but the cone itself.
  /// Then v takes the place of u, the vertex pinned there, and u moves into the rest of what was around it.
  bool take_over(VertexId v, VertexId u, const Hole& rest) {
    const DomainVertex cone = map_.pin[u];
    if (cone < 0) return false;
    unpin(map_, u);
    set_home(map_, u, -1, Vec2d(0, 0));
    pin_to(map_, v, cone);
    if (settle(u, rest)) return true;
    unpin(map_, v);
    set_home(map_, v, -1, Vec2d(0, 0));
    pin_to(map_, u, cone);
    return false;
  }

  Halfedge previous_around(Halfedge h) const { return next_in_triangle(map_.mesh.twins[h]); }

  /// The bisector of the hole's angle at the vertex that closed it, as long as the shorter of the two sides there.
  static Vec2d direction_into(const Hole& hole) {
    double angle = 0;
    for (std::size_t i = 1; i + 1 < hole.outline.size(); ++i) {
      const Vec2d p = hole.outline[i] - hole.centre();
      const Vec2d q = hole.outline[i + 1] - hole.centre();
      angle += std::atan2(cross(p, q), p.dot(q));
    }
    const Vec2d first = hole.outline[1] - hole.centre();
    const double last = (hole.outline.back() - hole.centre()).length();
    const Vec2d ahead = times(first, {std::cos(angle / 2), std::sin(angle / 2)});
    return ahead * (std::min(first.length(), last) / first.length());
  }

  bool put_at(VertexId v, const Hole& hole, const Vec2d& at) {
    if (!(smallest_area(hole.outline, at) > 0)) return false;
    // From inside of the slice that the point is seen in, so that the way there doesn't lead around u.
    std::size_t seen_in = 0;
    double best = -1e300;
    for (std::size_t i = 0; i < hole.slices.size(); ++i) {
      const Vec2d p = (hole.outline[i + 1] - hole.centre()).normalized();
      const Vec2d q = (hole.outline[i + 2] - hole.centre()).normalized();
      const double inside = std::min(cross(p, at - hole.centre()), cross(at - hole.centre(), q));
      if (inside > best) {
        best = inside;
        seen_in = i;
      }
    }
    const Hole::Slice& slice = hole.slices[seen_in];
    const auto& corners = slice.image.at;
    const Vec2d to = corners[0] + times(conjugate(slice.turn), at - hole.centre());
    const auto walked = walk(map_.domain, slice.image.frame, corner_at_home(slice.image), to);
    if (!walked) return false;
    set_home(map_, v, walked->home, walked->at);
    if (is_sound(map_, v)) return true;
    set_home(map_, v, -1, Vec2d(0, 0));
    return false;
  }

  /// A corner of the image that lies in the triangle whose frame the image is in.
  static Vec2d corner_at_home(const FlatImage& image) {
    const auto depth = [](const Vec2d& p) {
      const auto w = barycentrics(p);
      return std::min({w[0], w[1], w[2]});
    };
    return *std::max_element(image.at.begin(), image.at.end(),
                             [&](const Vec2d& p, const Vec2d& q) { return depth(p) < depth(q); });
  }

  WorkingMap& map_;
  RelaxScratch scratch_;
  std::vector<VertexId> ring_;
};

}  // namespace

void refine(WorkingMap& map, std::vector<Removal> removals, const RefineOptions& options, const Progress& progress) {
  Refinement refinement(map);
  const std::size_t coarse = map.mesh.outgoing.size() - removals.size();
  const std::size_t all = map.mesh.outgoing.size();
  std::size_t there = coarse;
  while (!removals.empty()) {
    const auto level = std::min(all, static_cast<std::size_t>(static_cast<double>(there) * options.level_growth) + 1);
    for (; there < level; ++there) {
      if (!refinement.put_back(removals.back())) {
        throw Error(ExitCode::kInternal,
                    "vertex " + std::to_string(removals.back().vertex) + " finds no place in the map");
      }
      removals.pop_back();
    }
    measure_rest_shapes(map);
    relax(map, vertices_by_triangle(map), {options.sweeps, 1e-3});
    report(progress, "bringing the map to the mesh", static_cast<double>(there) / static_cast<double>(all));
  }
}

}  // namespace lozenge
