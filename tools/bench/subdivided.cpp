// Each edge gets one new vertex, found by its two ends. It moves along the sum of the normals of the triangles beside
// it, which is its own normal before it moves: away from their planes, so that neither becomes thinner.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_map>

#include "formats/base/error.h"
#include "tools/bench/bench_mesh.h"
#include "tools/bench/random_numbers.h"

namespace lozenge::bench {
namespace {

/// Of a height beside it, that a midpoint may move: far from what would make two triangles touch.
constexpr double kMostOfHeight = 0.25;

struct Midpoint {
  VertexId a = -1, b = -1;
  Vec3d normal{0, 0, 0};  ///< sum over the triangles beside it, as long as twice their area
  double least_area = 0;  ///< of the triangles beside it
  double longest = 0;     ///< edge of the triangles beside it
};

double length_of(const Surface& mesh, VertexId a, VertexId b) {
  return (Vec3d(mesh.positions[a]) - Vec3d(mesh.positions[b])).length();
}

/// The midpoints of all edges, numbered in the order in which triangles first name them.
class Midpoints {
 public:
  explicit Midpoints(const Surface& mesh) {
    numbers_.reserve(mesh.triangles.size() * 3 / 2);
    for (const auto& triangle : mesh.triangles) add_sides(mesh, triangle);
  }

  const std::vector<Midpoint>& all() const { return all_; }
  std::int32_t number(VertexId a, VertexId b) const { return numbers_.at(key(a, b)); }

 private:
  static std::uint64_t key(VertexId a, VertexId b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
  }

  void add_sides(const Surface& mesh, const std::array<VertexId, 3>& t) {
    const Vec3d p(mesh.positions[t[0]]);
    const Vec3d normal = (Vec3d(mesh.positions[t[1]]) - p).cross(Vec3d(mesh.positions[t[2]]) - p);
    const double longest =
        std::max({length_of(mesh, t[0], t[1]), length_of(mesh, t[1], t[2]), length_of(mesh, t[2], t[0])});
    for (int side = 0; side < 3; ++side) {
      const VertexId a = t[side];
      const VertexId b = t[(side + 1) % 3];
      const auto [found, is_new] = numbers_.try_emplace(key(a, b), static_cast<std::int32_t>(all_.size()));
      if (is_new) all_.push_back({a, b, {0, 0, 0}, normal.length(), longest});
      Midpoint& midpoint = all_[found->second];
      midpoint.normal += normal;
      midpoint.least_area = std::min(midpoint.least_area, normal.length());
      midpoint.longest = std::max(midpoint.longest, longest);
    }
  }

  std::vector<Midpoint> all_;
  std::unordered_map<std::uint64_t, std::int32_t> numbers_;
};

double mean_length(const Surface& mesh, const std::vector<Midpoint>& edges) {
  double sum = 0;
  for (const Midpoint& edge : edges) sum += length_of(mesh, edge.a, edge.b);
  return sum / static_cast<double>(edges.size());
}

/// \param most  distance that it may move
Vec3f place_of(const Surface& mesh, const Midpoint& m, double most, RandomNumbers& random) {
  const Vec3d middle = (Vec3d(mesh.positions[m.a]) + Vec3d(mesh.positions[m.b])) * 0.5;
  // Half the least height of the large triangles is that of the small ones.
  const double height = m.longest > 0 ? 0.5 * m.least_area / m.longest : 0;
  const double distance = (2 * random.unit() - 1) * std::min(most, kMostOfHeight * height);
  return Vec3f(middle + m.normal.normalized() * distance);
}

Surface subdivided_once(const Surface& mesh, double noise, RandomNumbers& random) {
  const Midpoints midpoints(mesh);
  const auto old = static_cast<VertexId>(mesh.positions.size());
  const double most = noise * mean_length(mesh, midpoints.all()) / 2;
  Surface fine;
  fine.positions = mesh.positions;
  fine.positions.reserve(mesh.positions.size() + midpoints.all().size());
  for (const Midpoint& m : midpoints.all()) fine.positions.push_back(place_of(mesh, m, most, random));
  fine.triangles.reserve(mesh.triangles.size() * 4);
  for (const auto& [a, b, c] : mesh.triangles) {
    const VertexId ab = old + midpoints.number(a, b);
    const VertexId bc = old + midpoints.number(b, c);
    const VertexId ca = old + midpoints.number(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

bool has_area(const Surface& mesh, const std::array<VertexId, 3>& t) {
  const Vec3d p(mesh.positions[t[0]]);
  return (Vec3d(mesh.positions[t[1]]) - p).cross(Vec3d(mesh.positions[t[2]]) - p).length() > 0;
}

bool has_equal_positions(const Surface& mesh) {
  std::vector<Vec3f> sorted = mesh.positions;
  std::sort(sorted.begin(), sorted.end(), [](const Vec3f& a, const Vec3f& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  });
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

void require_sound(const Surface& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (has_area(mesh, mesh.triangles[t])) continue;
    throw Error(ExitCode::kUnusableInput, fmt::format("triangle {} of the subdivided mesh has no area; take another "
                                                      "mesh, or subdivide fewer times",
                                                      t));
  }
  if (has_equal_positions(mesh)) {
    throw Error(ExitCode::kUnusableInput,
                "vertices of the subdivided mesh fall together: floats are too coarse; subdivide fewer times");
  }
}

}  // namespace

Surface subdivided(const Surface& mesh, int times, double noise, std::uint64_t seed) {
  RandomNumbers random(seed);
  Surface fine = mesh;
  for (int k = 0; k < times; ++k) fine = subdivided_once(fine, noise, random);
  if (times > 0) require_sound(fine);
  return fine;
}

}  // namespace lozenge::bench
