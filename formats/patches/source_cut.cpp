// Most triangles lie in one patch and stay what they are. Of each other one the image is laid out over its patches
// (image_layout.h), its edges are cut where borders cross them, once for both sides (edge_cuts.h), and each patch takes
// its piece (cut_pieces.h).
#include "formats/patches/source_cut.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>
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
    whole_.resize(count);
    std::vector<std::vector<ImageLayout>> found((count + kPart - 1) / kPart);
    std::vector<std::size_t> broken(found.size(), kNone);
    for_each_part(count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto image = image_of(mesh_, map_, static_cast<TriangleId>(t));
        if (!image) {
          broken[begin / kPart] = t;
          return;
        }
        if (auto triangle = uncut(static_cast<TriangleId>(t), *image)) whole_[t] = *triangle;
        else
          found[begin / kPart].push_back(
              layout_of_image(map_.domain, places_, halves_, static_cast<TriangleId>(t), *image));
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
    result_.triangles.reserve(
        std::accumulate(made.begin(), made.end(), whole_.size() - straddling_.size(),
                        [](std::size_t sum, const CutPieces& pieces) { return sum + pieces.triangles.size(); }));
    std::size_t next = 0;
    for (std::size_t t = 0; t < whole_.size(); ++t) {
      if (whole_[t].source >= 0) {
        result_.triangles.push_back(whole_[t]);
        continue;
      }
      add(std::move(made[next++]));
    }
  }

  /// Inner points, which have numbers of their triangle until here, get theirs.
  void add(const CutPieces& made) {
    const auto first = static_cast<VertexId>(mesh_.positions.size() + result_.points.size());
    for (CutTriangle triangle : made.triangles) {
      for (CutCorner& corner : triangle.corners) {
        if (corner.vertex < 0) corner.vertex = first + (-1 - corner.vertex);
      }
      result_.triangles.push_back(triangle);
    }
    result_.points.resize(result_.points.size() + static_cast<std::size_t>(made.inner_points));
    result_.cut += made.triangles.size() > 1;
  }

  const SourceMesh& mesh_;
  const Parameterization& map_;
  const std::vector<PatchPlace>& places_;
  std::vector<PatchHalf> halves_;
  std::vector<CutTriangle> whole_;       ///< [source triangle] itself, where it isn't cut
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
