#include "stages/export/fitted_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/domain/sphere_fixtures.h"
#include "formats/surface/ray_scene.h"

namespace lozenge {
namespace {

/// A star-shaped piece: a sphere with waves, squeezed, turned, and put somewhere.
struct Piece {
  Vec3d waves{0, 0, 0};  ///< how many, along each axis
  double depth = 0;      ///< of them, by the radius
  bool is_box = false;
  Vec3d size{1, 1, 1};
  double turn = 0;
  Vec3d middle{0, 0, 0};

  Vec3d at(const Vec3d& unit) const {
    double radius = 1 + depth * std::sin(waves.x * unit.x) * std::sin(waves.y * unit.y + waves.z * unit.z);
    if (is_box) radius = 1 / std::max({std::abs(unit.x), std::abs(unit.y), std::abs(unit.z)});
    const Vec3d p = unit * radius * size;
    return Vec3d(p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn), p.z) +
           middle;
  }
};

constexpr int kPieces = 4;

/// Blades, needles, boxes and lumps, side by side.
std::vector<Piece> random_pieces(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random()) / 4294967296.0;
  };
  std::vector<Piece> pieces(kPieces);
  for (int i = 0; i < kPieces; ++i) {
    Piece& piece = pieces[static_cast<std::size_t>(i)];
    piece.waves = Vec3d(between(1, 9), between(1, 9), between(1, 9));
    piece.depth = between(0, 0.4);
    piece.is_box = between(0, 1) < 0.3;
    for (int k = 0; k < 3; ++k) piece.size[k] = std::exp(between(-3, 0));
    piece.turn = between(0, 6);
    piece.middle = Vec3d(3 * i, between(-1, 1), 0);
  }
  return pieces;
}

struct Source {
  SourceMesh mesh;
  Parameterization map;
};

/// Each an octahedron's sphere of 8 * n * n triangles.
Source source_of(const std::vector<Piece>& pieces, int n) {
  constexpr double kApart = 100;
  const std::vector<Vec3d> corners{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<DomainVertex, 3>> faces;
  std::vector<Vec3d> places;
  for (int i = 0; i < kPieces; ++i) {
    const auto first = static_cast<DomainVertex>(places.size());
    for (const Vec3d& c : corners) places.push_back(c + Vec3d(kApart * i, 0, 0));
    for (const auto& f :
         {std::array{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}})
      faces.push_back({first + f[0], first + f[1], first + f[2]});
  }
  Source made;
  std::tie(made.mesh, made.map) = fixtures::subdivided(
      make_domain(faces, static_cast<std::int32_t>(places.size())), n, places, [&](const Vec3d& times_n) {
        const Vec3d flat = times_n / n;
        const int i = static_cast<int>(std::lround(flat.x / kApart));
        return pieces[static_cast<std::size_t>(i)].at((flat - Vec3d(kApart * i, 0, 0)).normalized());
      });
  return made;
}

int piece_at(const Vec3f& p) { return std::clamp(static_cast<int>(std::lround(p.x / 3)), 0, kPieces - 1); }

/// Of one piece.
struct Part {
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> triangles;
};

std::vector<Part> parts_of(const ChartedSurface& surface) {
  std::vector<Part> parts(kPieces);
  for (const ChartedTriangle& t : surface.triangles) {
    Part& part = parts[static_cast<std::size_t>(piece_at(surface.positions[t.corners[0].vertex]))];
    const auto first = static_cast<VertexId>(part.positions.size());
    for (const ChartedCorner& c : t.corners) part.positions.push_back(surface.positions[c.vertex]);
    part.triangles.push_back({first, first + 1, first + 2});
  }
  return parts;
}

double farthest(const Part& from, const Part& to) {
  const RayScene scene(to.positions, to.triangles);
  double most = 0;
  for (const Vec3f& p : from.positions) most = std::max(most, static_cast<double>(scene.nearest(Vec3d(p)).distance));
  return most;
}

TEST(FittedLevels, LoseTheShapeOfNoPieceThatIsLargeEnoughToBeSeen) {
  constexpr int kSide = 12;
  constexpr double kSeen = 0.1;  // by the largest: of smaller ones little is left
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U, 10U}) {
    const std::vector<Piece> pieces = random_pieces(seed);
    const Source source = source_of(pieces, kSide);
    const PatchLayout patches = patch_layout(source.mesh, source.map, 5);
    const MapLayout layout = make_map_layout(patches, 512, 4);
    FittedLevels levels({&source.mesh, &source.map}, patches, layout);
    const std::vector<Part> whole = parts_of(levels.source());
    double largest = 0;
    for (const Part& part : whole) largest = std::max(largest, diagonal(bounds_of(part.positions)));
    const std::int64_t all = 8 * kSide * kSide * kPieces;
    // By the piece's extent, of small ones by a third of the largest's. Levels are off by half of that, where the shape
    // is lost it is the extent itself.
    for (const auto& [share, allowed] : {std::pair(4, 0.03), std::pair(16, 0.06), std::pair(64, 0.2)}) {
      const std::vector<Part> level = parts_of(levels.next(all / share));
      for (int i = 0; i < kPieces; ++i) {
        const Part& was = whole[static_cast<std::size_t>(i)];
        const Part& is = level[static_cast<std::size_t>(i)];
        const double extent = diagonal(bounds_of(was.positions));
        if (extent < kSeen * largest) continue;
        ASSERT_FALSE(is.triangles.empty()) << "seed " << seed << ", piece " << i << ", a " << share << "th";
        const double off = std::max(farthest(was, is), farthest(is, was));
        EXPECT_LT(off, allowed * std::max(extent, largest / 3))
            << "seed " << seed << ", piece " << i << ", a " << share << "th, " << is.triangles.size() << " triangles";
      }
    }
  }
}

}  // namespace
}  // namespace lozenge
