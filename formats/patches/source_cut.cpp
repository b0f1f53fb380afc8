// Most triangles lie in one patch and stay what they are. Of each other one the image is laid out over its patches
// (image_layout.h), its edges are cut where borders cross them, once for both sides (edge_cuts.h), and each patch takes
// its piece (cut_pieces.h).
#include "formats/patches/source_cut.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/cut_pieces.h"
#include "formats/patches/edge_cuts.h"
#include "formats/patches/image_layout.h"
#include "formats/surface/boundary.h"

namespace lozenge {

namespace {

class Cutter {
 public:
  Cutter(const SourceMesh& mesh, const Parameterization& map, const std::vector<PatchPlace>& places, double together)
      : mesh_(mesh), map_(map), places_(places), halves_(patch_halves(places)), cuts_(mesh), together_(together) {}

  CutSurface run() {
    find_layouts();
    for (const ImageLayout& layout : straddling_) cuts_.add(layout);
    result_.points = cuts_.points();
    make_pieces();
    return std::move(result_);
  }

 private:
  void find_layouts() {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const std::size_t count = mesh_.triangles.size();
    is_whole_.assign(count, 0);
    std::vector<std::vector<ImageLayout>> found((count + kPart - 1) / kPart);
    std::vector<std::size_t> broken(found.size(), kNone);
    for_each_part(count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto image = image_of(mesh_, map_, static_cast<TriangleId>(t));
        if (!image) {
          broken[begin / kPart] = t;
          return;
        }
        if (uncut(static_cast<TriangleId>(t), *image)) {
          is_whole_[t] = 1;
        } else {
          found[begin / kPart].push_back(
              layout_of_image(map_.domain, places_, halves_, static_cast<TriangleId>(t), *image));
        }
      }
    });
    for (const std::size_t t : broken) {
      if (t != kNone) {
        throw Error(ExitCode::kUnusableInput, mesh_.origin + ": triangle " + std::to_string(t) +
                                                  " has no image on the domain; make the map again");
      }
    }
    for (std::vector<ImageLayout>& part : found) std::move(part.begin(), part.end(), std::back_inserter(straddling_));
    for (ImageLayout& layout : straddling_) layout.together = together_;
  }

  /// The triangle as it is, where one patch of its home holds all of its image.
  std::optional<CutTriangle> uncut(TriangleId t, const Development& image) const {
    for (int side = 0; side < 3; ++side) {
      const PatchBelow patch = patch_below(places_, halves_, {image.home, {}}, side);
      CutTriangle whole{t, patch.patch, {}};
      bool inside = true;
      for (int c = 0; c < 3 && inside; ++c) {
        const LatticePoint square = in_square(patch.from_home(image.corners[c]));
        inside = square.u >= 0 && square.v >= 0 && square.u <= kLatticeOne && square.v <= kLatticeOne;
        Vec3d weights(0, 0, 0);
        weights[c] = 1;
        whole.corners[c] = {mesh_.triangles[t][c], weights, in_sides(square)};
      }
      if (inside) return whole;
    }
    return std::nullopt;
  }

  void make_pieces() {
    std::vector<CutPieces> made(straddling_.size());
    for_each_part(straddling_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) made[i] = pieces_of(mesh_, cuts_, straddling_[i]);
    });
    const std::vector<Begin> begins = begins_of_parts(made);
    for_each_part(is_whole_.size(), [&](std::size_t begin, std::size_t end) {
      Begin next = begins[begin / kPart];
      for (std::size_t t = begin; t < end; ++t) {
        if (is_whole_[t] != 0) {
          const auto source = static_cast<TriangleId>(t);
          result_.triangles[next.triangle++] = *uncut(source, *image_of(mesh_, map_, source));
        } else {
          put(made[next.straddling++], next);
        }
      }
    });
  }

  /// Where what comes of a part of the source's triangles begins.
  struct Begin {
    std::size_t straddling = 0;
    std::size_t triangle = 0;  ///< of the result
    std::size_t point = 0;
  };

  /// Makes room for all.
  std::vector<Begin> begins_of_parts(const std::vector<CutPieces>& made) {
    std::vector<Begin> begins;
    Begin next{0, 0, result_.points.size()};
    for (std::size_t t = 0; t < is_whole_.size(); ++t) {
      if (t % kPart == 0) begins.push_back(next);
      if (is_whole_[t] != 0) {
        ++next.triangle;
        continue;
      }
      const CutPieces& pieces = made[next.straddling++];
      next.triangle += pieces.triangles.size();
      next.point += static_cast<std::size_t>(pieces.inner_points);
      result_.cut += pieces.triangles.size() > 1;
    }
    result_.triangles.resize(next.triangle);
    result_.points.resize(next.point);
    return begins;
  }

  /// Inner points, which have numbers of their triangle until here, get theirs.
  void put(const CutPieces& made, Begin& next) {
    const auto first = static_cast<VertexId>(mesh_.positions.size() + next.point);
    for (CutTriangle triangle : made.triangles) {
      for (CutCorner& corner : triangle.corners) {
        if (corner.vertex < 0) corner.vertex = first + (-1 - corner.vertex);
      }
      result_.triangles[next.triangle++] = triangle;
    }
    next.point += static_cast<std::size_t>(made.inner_points);
  }

  const SourceMesh& mesh_;
  const Parameterization& map_;
  const std::vector<PatchPlace>& places_;
  std::vector<PatchHalf> halves_;
  std::vector<std::uint8_t> is_whole_;   ///< [source triangle] it isn't cut; made twice, for it is large
  std::vector<ImageLayout> straddling_;  ///< the others
  EdgeCuts cuts_;
  double together_;
  CutSurface result_;
};

/// Whether pieces fit together: no side is there twice, and they end where the source does.
bool is_whole(const SourceMesh& mesh, const CutSurface& cut) {
  std::vector<std::array<VertexId, 3>> pieces;
  pieces.reserve(cut.triangles.size());
  for (const CutTriangle& t : cut.triangles) {
    pieces.push_back({t.corners[0].vertex, t.corners[1].vertex, t.corners[2].vertex});
  }
  if (has_repeated_sides(pieces)) return false;
  const std::vector<BoundarySide> ends = boundary_sides(mesh.triangles);
  std::size_t due = ends.size();
  for (const CutPoint& point : cut.points) {
    for (const BoundarySide& side : {point.ends, BoundarySide{point.ends[1], point.ends[0]}}) {
      due += std::binary_search(ends.begin(), ends.end(), side) ? 1 : 0;
    }
  }
  return boundary_sides(pieces).size() == due;
}

}  // namespace

CutSurface cut_along_patches(const SourceMesh& mesh, const Parameterization& map,
                             const std::vector<PatchPlace>& places) {
  // What is nearer than rounding can tell is taken to be in one place. Where places are as far apart as that, cuts may
  // be counted as one in a triangle and as two beside it; with another measure they are not.
  for (const double factor : {1.0, 16.0, 1.0 / 16, 256.0, 4096.0}) {
    CutSurface cut = Cutter(mesh, map, places, factor * kTogether).run();
    if (is_whole(mesh, cut)) return cut;
  }
  throw Error(ExitCode::kInternal, mesh.origin +
                                       ": the pieces of its triangles don't fit together along the patches; "
                                       "--finest samples does without them");
}

}  // namespace lozenge
