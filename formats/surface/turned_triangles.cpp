#include "formats/surface/turned_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

/// Twice the triangle's area along its normal; zero where the triangle is less high than `least`.
Vec3d cross_of(const SurfaceView& surface, const std::array<VertexId, 3>& t, double least) {
  const Vec3d a(surface.positions[t[0]]);
  const Vec3d b = Vec3d(surface.positions[t[1]]) - a;
  const Vec3d c = Vec3d(surface.positions[t[2]]) - a;
  const Vec3d cross = b.cross(c);
  const double longest = std::sqrt(std::max({b.length2(), c.length2(), (c - b).length2()}));
  return cross.length() > least * longest ? cross : Vec3d(0, 0, 0);
}

struct Side {
  std::array<VertexId, 2> ends;  ///< from, to
  TriangleId triangle;
  auto operator<=>(const Side&) const = default;
};

/// The sides of all triangles, sorted.
class Sides {
 public:
  explicit Sides(std::span<const std::array<VertexId, 3>> triangles) {
    sides_.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        sides_.push_back({{triangles[t][k], triangles[t][(k + 1) % 3]}, static_cast<TriangleId>(t)});
      }
    }
    sort_on_all_threads(sides_);
  }

  /// The last triangle that has the side, or -1.
  TriangleId triangle(const std::array<VertexId, 2>& ends) const {
    const Side beyond{ends, std::numeric_limits<TriangleId>::max()};
    const auto next = std::upper_bound(sides_.begin(), sides_.end(), beyond);
    return next != sides_.begin() && std::prev(next)->ends == ends ? std::prev(next)->triangle : -1;
  }

 private:
  std::vector<Side> sides_;
};

}  // namespace

std::vector<TriangleId> turned_triangles(const SurfaceView& surface, double least_height) {
  constexpr double kAgainst = -0.95;  // cosine
  const std::size_t count = surface.triangles.size();
  const Sides sides(surface.triangles);
  std::vector<Vec3d> normals(count);
  for_each_part(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) normals[t] = cross_of(surface, surface.triangles[t], least_height);
  });
  std::vector<std::uint8_t> is_turned(count, 0);
  for_each_part(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      int against = 0;
      int neighbours = 0;
      for (int k = 0; k < 3; ++k) {
        const TriangleId other = sides.triangle({surface.triangles[t][(k + 1) % 3], surface.triangles[t][k]});
        if (other < 0) continue;
        const Vec3d& n = normals[other];
        ++neighbours;
        if (normals[t].dot(n) < kAgainst * normals[t].length() * n.length()) ++against;
      }
      is_turned[t] = neighbours > 1 && against == neighbours ? 1 : 0;
    }
  });
  std::vector<TriangleId> turned;
  for (std::size_t t = 0; t < count; ++t) {
    if (is_turned[t] != 0) turned.push_back(static_cast<TriangleId>(t));
  }
  return turned;
}

}  // namespace lozenge
