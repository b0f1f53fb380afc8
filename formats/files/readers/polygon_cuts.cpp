#include "formats/files/readers/polygon_cuts.h"

#include <cmath>
#include <numeric>

namespace lozenge {

namespace {

/// Looking for ears takes the square of this, at worst the cube.
constexpr std::size_t kMostCornersWithEars = 128;

using Corners = std::span<const Vec3f>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Twice the area, as a vector (M. E. Newell's sum over the sides); it doesn't mind a polygon that isn't flat.
Vec3d area_vector(Corners corners) {
  Vec3d sum(0, 0, 0);
  const Vec3d origin(corners[0]);
  for (std::size_t k = 2; k < corners.size(); ++k) {
    sum += (Vec3d(corners[k - 1]) - origin).cross(Vec3d(corners[k]) - origin);
  }
  return sum;
}

double turn_at(Corners corners, const Vec3d& normal, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return (Vec3d(corners[b]) - Vec3d(corners[a])).cross(Vec3d(corners[c]) - Vec3d(corners[a])).dot(normal);
}

void add_fan(std::span<const std::uint32_t> ring, Triangles& triangles) {
  for (std::size_t k = 2; k < ring.size(); ++k) triangles.push_back({ring[0], ring[k - 1], ring[k]});
}

bool fan_folds(Corners corners, const Vec3d& normal) {
  for (std::uint32_t k = 2; k < corners.size(); ++k) {
    if (!(turn_at(corners, normal, 0, k - 1, k) > 0)) return true;
  }
  return false;
}

/// Whether the triangle at this place of the ring turns the right way and none of the ring's other corners lies in it,
/// but for those at one of its own.
bool is_ear(Corners corners, const Vec3d& normal, const std::vector<std::uint32_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const std::uint32_t a = ring[(at + n - 1) % n];
  const std::uint32_t b = ring[at];
  const std::uint32_t c = ring[(at + 1) % n];
  if (!(turn_at(corners, normal, a, b, c) > 0)) return false;
  for (const std::uint32_t p : ring) {
    if (corners[p] == corners[a] || corners[p] == corners[b] || corners[p] == corners[c]) continue;
    const bool inside = turn_at(corners, normal, a, b, p) >= 0 && turn_at(corners, normal, b, c, p) >= 0 &&
                        turn_at(corners, normal, c, a, p) >= 0;
    if (inside) return false;
  }
  return true;
}

void cut_ears(Corners corners, const Vec3d& normal, std::vector<std::uint32_t>& ring, Triangles& triangles) {
  std::size_t at = 1;
  std::size_t tried = 0;
  while (ring.size() > 3 && tried < ring.size()) {
    at %= ring.size();
    if (!is_ear(corners, normal, ring, at)) {
      ++at;
      ++tried;
      continue;
    }
    const std::size_t n = ring.size();
    triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    tried = 0;
  }
  add_fan(ring, triangles);
}

}  // namespace

void cut_polygon(Corners corners, Triangles& triangles) {
  triangles.clear();
  if (corners.size() == 3) {
    triangles.push_back({0, 1, 2});
    return;
  }
  std::vector<std::uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0U);
  const Vec3d normal = corners.size() > 3 ? area_vector(corners) : Vec3d(0, 0, 0);
  if (corners.size() > kMostCornersWithEars || normal == Vec3d(0, 0, 0) || !fan_folds(corners, normal)) {
    add_fan(ring, triangles);
  } else {
    cut_ears(corners, normal, ring, triangles);
  }
}

}  // namespace lozenge
