// A triangle's image is found once, and walked across the domain's sides into every triangle that it overlaps. In each,
// a grid of bins holds the images over it; to find a place is to ask those of one bin, in integers: the first that
// holds it answers, so that a place on an edge has one answer, too.
#include "formats/domain/source_locator.h"

#include <algorithm>
#include <string>

#include "formats/base/error.h"
#include "formats/base/parallel.h"

namespace lozenge {

namespace {

using Corners = std::array<LatticePoint, 3>;

/// Source triangles that one task handles. Results are joined block by block, so that the order does not depend on
/// threads.
constexpr std::size_t kBlock = 8192;

/// An image lies across a handful of domain triangles; a broken map could wind one around its vertices forever.
constexpr std::size_t kMostPieces = 256;

/// An image in the frame of a domain triangle that it overlaps.
struct Piece {
  DomainTriangleId triangle;
  Corners corners;
  friend bool operator==(const Piece&, const Piece&) = default;
};

/// Which side of the line from p to q the point is on.
int side_of_line(LatticePoint p, LatticePoint q, LatticePoint x) {
  const LatticeArea area = doubled_area(p, q, x);
  return (area > 0) - (area < 0);
}

/// The inside of the triangle meets the inside of the segment. They don't exactly where a line along one of the
/// triangle's edges, or along the segment, has one on either side.
bool crosses(const Corners& triangle, LatticePoint p, LatticePoint q) {
  for (int e = 0; e < 3; ++e) {
    const LatticePoint a = triangle[e];
    const LatticePoint b = triangle[(e + 1) % 3];
    if (side_of_line(a, b, p) <= 0 && side_of_line(a, b, q) <= 0) return false;
  }
  bool left = false;
  bool right = false;
  for (const LatticePoint c : triangle) {
    left |= side_of_line(p, q, c) > 0;
    right |= side_of_line(p, q, c) < 0;
  }
  return left && right;
}

/// Every domain triangle that has some area in common with the image, starting at its home. The inside of an image is
/// flat, so it is followed across the insides of sides alone; turning around a vertex that it only touches would bend
/// it. \return nothing where the image winds on without end
bool find_pieces(const Domain& domain, const Development& image, std::vector<Piece>& pieces) {
  constexpr Corners kFrame{{{0, 0}, {kLatticeOne, 0}, {0, kLatticeOne}}};
  pieces.assign(1, {image.home, image.corners});
  if (image.span == Span::kFace) return true;
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    const Piece here = pieces[n];
    for (int s = 0; s < 3; ++s) {
      const DomainSide across = domain.neighbour({here.triangle, s});
      if (!across.exists() || !crosses(here.corners, kFrame[s], kFrame[(s + 1) % 3])) continue;
      const LatticeMotion move = inverse(transition(s, across.side));
      const Piece there{across.triangle, {move(here.corners[0]), move(here.corners[1]), move(here.corners[2])}};
      if (std::find(pieces.begin(), pieces.end(), there) != pieces.end()) continue;
      if (pieces.size() == kMostPieces) return false;
      pieces.push_back(there);
    }
  }
  return true;
}

/// What one task finds.
struct Block {
  std::vector<DomainTriangleId> triangles;  ///< [image]
  std::vector<SourceLocator::Image> images;
  std::vector<Corners> moved;
  TriangleId broken = -1;
};

Block find_images(const SourceMesh& mesh, const Parameterization& map, std::size_t first, std::size_t last) {
  Block block;
  std::vector<Piece> pieces;
  for (std::size_t t = first; t < last; ++t) {
    const auto source = static_cast<TriangleId>(t);
    const std::optional<Development> image = image_of(mesh, map, source);
    if (!image || doubled_area(image->corners[0], image->corners[1], image->corners[2]) <= 0 ||
        !find_pieces(map.domain, *image, pieces)) {
      block.broken = source;
      return block;
    }
    const auto& [a, b, c] = mesh.triangles[t];
    const DomainTriangleId own = map.phi[a].triangle;
    const bool at_home = map.phi[b].triangle == own && map.phi[c].triangle == own;
    for (const Piece& piece : pieces) {
      block.triangles.push_back(piece.triangle);
      if (at_home) {
        block.images.push_back({source, -1});
      } else {
        block.images.push_back({source, static_cast<std::int32_t>(block.moved.size())});
        block.moved.push_back(piece.corners);
      }
    }
  }
  return block;
}

/// floor(a * b / c) for c > 0 and a result of lattice size.
std::int64_t scaled(std::int64_t a, std::int64_t b, std::int64_t c) {
  const LatticeArea product = static_cast<LatticeArea>(a) * b;
  return static_cast<std::int64_t>(product / c - (product % c < 0));
}

/// Smallest and largest u of the triangle between two rows, a lattice step wider where it isn't whole; low > high where
/// it isn't there.
struct Extent {
  std::int64_t low = INT64_MAX;
  std::int64_t high = INT64_MIN;

  void add(std::int64_t u) {
    low = std::min(low, u);
    high = std::max(high, u);
  }
};

Extent extent_between(const Corners& triangle, std::int64_t low_v, std::int64_t high_v) {
  Extent extent;
  for (int e = 0; e < 3; ++e) {
    LatticePoint a = triangle[e];
    LatticePoint b = triangle[(e + 1) % 3];
    if (a.v > b.v) std::swap(a, b);
    if (low_v <= a.v && a.v <= high_v) extent.add(a.u);
    if (low_v <= b.v && b.v <= high_v) extent.add(b.u);
    for (const std::int64_t v : {low_v, high_v}) {
      if (a.v >= v || b.v <= v) continue;
      const std::int64_t u = a.u + scaled(b.u - a.u, v - a.v, b.v - a.v);
      extent.add(u);
      extent.add(u + 1);
    }
  }
  return extent;
}

}  // namespace

Vec3f position_at(const SourceMesh& mesh, const SourcePoint& p) {
  Vec3d sum(0, 0, 0);
  for (int c = 0; c < 3; ++c) sum += Vec3d(mesh.positions[mesh.triangles[p.triangle][c]]) * p.weights[c];
  return Vec3f(sum) + Vec3f(0, 0, 0);  // -0 + 0 = 0
}

SourceLocator::SourceLocator(const SourceMesh& mesh, const Parameterization& map) : mesh_(mesh), map_(map) {
  std::vector<Block> blocks((mesh.triangles.size() + kBlock - 1) / kBlock);
  for_each_index(blocks.size(), true, [&](std::size_t n) {
    blocks[n] = find_images(mesh, map, n * kBlock, std::min(mesh.triangles.size(), (n + 1) * kBlock));
  });
  first_.assign(static_cast<std::size_t>(map.domain.size()) + 1, 0);
  std::size_t moved = 0;
  for (const Block& block : blocks) {
    if (block.broken >= 0) {
      throw Error(ExitCode::kUnusableInput,
                  mesh.origin + ": the image of source triangle " + std::to_string(block.broken) +
                      " is folded, or its corners lie too far apart on the domain; parameterize the mesh again");
    }
    for (const DomainTriangleId t : block.triangles) ++first_[t + 1];
    moved += block.moved.size();
  }
  for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
  images_.resize(first_.back());
  moved_.reserve(moved);
  std::vector<std::size_t> next = first_;
  for (Block& block : blocks) {
    const auto offset = static_cast<std::int32_t>(moved_.size());
    for (std::size_t n = 0; n < block.images.size(); ++n) {
      Image image = block.images[n];
      if (image.moved >= 0) image.moved += offset;
      images_[next[block.triangles[n]]++] = image;
    }
    moved_.insert(moved_.end(), block.moved.begin(), block.moved.end());
    block = {};
  }
}

std::array<LatticePoint, 3> SourceLocator::corners(const Image& image) const {
  if (image.moved >= 0) return moved_[image.moved];
  const auto& [a, b, c] = mesh_.triangles[image.source];
  return {lattice_point(map_.phi[a]), lattice_point(map_.phi[b]), lattice_point(map_.phi[c])};
}

TriangleLocator::TriangleLocator(const SourceLocator& all, DomainTriangleId triangle)
    : all_(all), images_(all.over(triangle)) {
  // About two images a bin: half of the bins lie outside the triangle.
  while (bins_ < 2048 && static_cast<std::size_t>(bins_) * bins_ < images_.size()) {
    bins_ *= 2;
    --shift_;
  }
  std::vector<std::int32_t> counts(static_cast<std::size_t>(bins_) * bins_ + 1, 0);
  for (const SourceLocator::Image& image : images_) {
    for_each_bin(all_.corners(image), [&](std::size_t b) { ++counts[b + 1]; });
  }
  for (std::size_t b = 1; b < counts.size(); ++b) counts[b] += counts[b - 1];
  first_ = counts;
  listed_.resize(static_cast<std::size_t>(first_.back()));
  for (std::size_t n = 0; n < images_.size(); ++n) {
    for_each_bin(all_.corners(images_[n]), [&](std::size_t b) { listed_[counts[b]++] = static_cast<std::int32_t>(n); });
  }
}

std::int32_t TriangleLocator::bin(std::int64_t coordinate) const {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(coordinate >> shift_, 0, bins_ - 1));
}

template <typename Visit>
void TriangleLocator::for_each_bin(const Corners& corners, Visit visit) const {
  const auto [low, high] = std::minmax({corners[0].v, corners[1].v, corners[2].v});
  for (std::int32_t row = bin(low); row <= bin(high); ++row) {
    const std::int64_t start = std::int64_t{row} << shift_;
    // The last row also holds v = 1.
    const Extent extent = extent_between(corners, start, start + (std::int64_t{1} << shift_));
    if (extent.low > extent.high || extent.high < 0 || extent.low > kLatticeOne) continue;
    for (std::int32_t column = bin(extent.low); column <= bin(extent.high); ++column) {
      visit(static_cast<std::size_t>(row) * bins_ + column);
    }
  }
}

DomainLocator::DomainLocator(const SourceMesh& mesh, const Parameterization& map)
    : all_(mesh, map), triangles_(map.domain.triangles.size()) {
  for_each_index(triangles_.size(), true,
                 [&](std::size_t t) { triangles_[t].emplace(all_, static_cast<DomainTriangleId>(t)); });
}

namespace {

/// The weights of a place in an image; nothing where it lies outside.
std::optional<Vec3d> weights_in(const Corners& image, LatticePoint place) {
  const auto& [p, q, r] = image;
  const LatticeArea at_p = doubled_area(place, q, r);
  const LatticeArea at_q = doubled_area(place, r, p);
  const LatticeArea at_r = doubled_area(place, p, q);
  if (at_p < 0 || at_q < 0 || at_r < 0) return std::nullopt;
  const auto whole = static_cast<double>(at_p + at_q + at_r);
  return Vec3d(static_cast<double>(at_p) / whole, static_cast<double>(at_q) / whole, static_cast<double>(at_r) / whole);
}

/// Areas are linear in the place: the one of (place, q, r) changes by q.v - r.v along u, by r.u - q.u along v.
LocatedPoint with_derivatives(const SourcePoint& point, const Corners& image) {
  LocatedPoint located{point};
  const auto whole = static_cast<double>(doubled_area(image[0], image[1], image[2]));
  constexpr auto kSide = static_cast<double>(kLatticeOne);
  for (int c = 0; c < 3; ++c) {
    const LatticePoint across = image[(c + 1) % 3] - image[(c + 2) % 3];
    located.along_u[c] = static_cast<double>(across.v) * kSide / whole;
    located.along_v[c] = static_cast<double>(-across.u) * kSide / whole;
  }
  return located;
}

}  // namespace

template <typename Found>
void TriangleLocator::find_image(LatticePoint place, const Found& found) const {
  const std::size_t b = static_cast<std::size_t>(bin(place.v)) * bins_ + bin(place.u);
  for (std::int32_t n = first_[b]; n < first_[b + 1]; ++n) {
    const SourceLocator::Image& image = images_[listed_[n]];
    const Corners corners = all_.corners(image);
    if (const auto weights = weights_in(corners, place)) return found(SourcePoint{image.source, *weights}, corners);
  }
}

std::optional<SourcePoint> TriangleLocator::find(LatticePoint place) const {
  std::optional<SourcePoint> result;
  find_image(place, [&](const SourcePoint& point, const Corners&) { result = point; });
  return result;
}

std::optional<LocatedPoint> TriangleLocator::locate(LatticePoint place) const {
  std::optional<LocatedPoint> result;
  find_image(place,
             [&](const SourcePoint& point, const Corners& corners) { result = with_derivatives(point, corners); });
  return result;
}

}  // namespace lozenge
