// The points of a triangle are its corners, the cuts of its edges, and the corners of patches inside of it. A patch's
// part of the image is convex, and its corners are those of the points that lie in the patch; sorted around their
// middle they are the piece.
#include "formats/patches/cut_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lozenge {

namespace {

/// A point of a source triangle.
struct Point {
  VertexId vertex = -1;
  Vec2d at;  ///< in the home's frame
  Vec3d weights;
  int corner = -1;  ///< of the image, where it is one
};

class PieceMaker {
 public:
  PieceMaker(const SourceMesh& mesh, const EdgeCuts& cuts) : mesh_(mesh), cuts_(cuts) {}

  CutPieces run(const ImageLayout& layout) const {
    CutPieces made;
    std::vector<Point> points = points_of(layout);
    const std::size_t on_rim = points.size();
    add_inner_points(layout, points);
    made.inner_points = static_cast<std::int32_t>(points.size() - on_rim);
    std::vector<std::vector<std::size_t>> held;  // [patch] points, ascending
    for (const PatchBelow& patch : layout.patches) held.push_back(points_in(patch, points, layout.together));
    for (std::size_t p = 0; p < held.size(); ++p) {
      if (is_part_of_another(held, p)) continue;
      const std::vector<Point> piece = piece_of(held[p], points, layout.together);
      if (piece.size() >= 3) triangulate(layout, layout.patches[p], piece, made.triangles);
    }
    return made;
  }

 private:
  /// Corners and cuts of the edges, counter-clockwise.
  std::vector<Point> points_of(const ImageLayout& layout) const {
    std::vector<Point> points;
    const auto& corners = mesh_.triangles[layout.source];
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      Vec3d weights(0, 0, 0);
      weights[c] = 1;
      points.push_back({corners[c], in_sides(layout.image.corners[c]), weights, c});
      const CutsOfEdge& cuts = cuts_.at(corners[c], corners[next]);
      const bool forward = corners[c] < corners[next];
      const int low = forward ? c : next;
      const int high = forward ? next : c;
      for (std::int32_t k = 0; k < cuts.count; ++k) {
        const std::int32_t point = cuts.first + (forward ? k : cuts.count - 1 - k);
        const double share = cuts_.points()[point].share;
        const Vec2d from = in_sides(layout.image.corners[low]);
        Vec3d w(0, 0, 0);
        w[low] = 1 - share;
        w[high] = share;
        points.push_back({static_cast<VertexId>(mesh_.positions.size()) + point,
                          from + (in_sides(layout.image.corners[high]) - from) * share, w, -1});
      }
    }
    return points;
  }

  /// Corners of patches inside of the image; numbered -1, -2, ... until all are known.
  static void add_inner_points(const ImageLayout& layout, std::vector<Point>& points) {
    const std::array<Vec2d, 3> image{in_sides(layout.image.corners[0]), in_sides(layout.image.corners[1]),
                                     in_sides(layout.image.corners[2])};
    const double area = (image[1] - image[0]).cross(image[2] - image[0]);
    const std::size_t first = points.size();
    const auto add = [&](LatticePoint three_times) {
      const Vec2d p = in_sides(three_times) / 3;
      Vec3d weights;
      for (int c = 0; c < 3; ++c) {
        const Vec2d side = image[(c + 2) % 3] - image[(c + 1) % 3];
        const double across = side.cross(p - image[(c + 1) % 3]);
        if (across <= layout.together * side.length()) return;
        weights[c] = across / area;
      }
      const auto is_here = [&](const Point& other) {
        return (other.at - p).length2() < layout.together * layout.together;
      };
      if (std::any_of(points.begin(), points.end(), is_here)) return;
      points.push_back({-1 - static_cast<VertexId>(points.size() - first), p, weights, -1});
    };
    for (const Spoke& spoke : spokes_below(layout)) {
      add(spoke.barycentre);
      add(spoke.corner);
    }
  }

  static std::vector<std::size_t> points_in(const PatchBelow& patch, const std::vector<Point>& points,
                                            double together) {
    const double slack = 4 * together;
    std::vector<std::size_t> held;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (holds(patch, place_in(patch, points[i].at), slack)) held.push_back(i);
    }
    return held;
  }

  /// Whether another patch holds all points of a patch, too: then they are its own border, up to rounding, and what is
  /// between them is the other's. Of patches that hold the same, the first has it.
  static bool is_part_of_another(const std::vector<std::vector<std::size_t>>& held, std::size_t patch) {
    for (std::size_t other = 0; other < held.size(); ++other) {
      if (other == patch) continue;
      const bool all = std::includes(held[other].begin(), held[other].end(), held[patch].begin(), held[patch].end());
      if (all && (held[other].size() > held[patch].size() || other < patch)) return true;
    }
    return false;
  }

  /// Counter-clockwise; fewer than three, or without area, where there is none.
  static std::vector<Point> piece_of(const std::vector<std::size_t>& held, const std::vector<Point>& points,
                                     double together) {
    std::vector<Point> piece;
    Vec2d middle(0, 0);
    for (const std::size_t i : held) {
      piece.push_back(points[i]);
      middle += points[i].at;
    }
    if (piece.size() < 3) return {};
    middle /= static_cast<double>(piece.size());
    const auto angle = [&](const Point& p) { return std::atan2(p.at.y - middle.y, p.at.x - middle.x); };
    std::stable_sort(piece.begin(), piece.end(), [&](const Point& a, const Point& b) { return angle(a) < angle(b); });
    double area = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      area += (piece[i].at - middle).cross(piece[(i + 1) % piece.size()].at - middle);
    }
    if (!(area > together * together)) return {};
    return piece;
  }

  void triangulate(const ImageLayout& layout, const PatchBelow& patch, const std::vector<Point>& piece,
                   std::vector<CutTriangle>& triangles) const;

  CutCorner corner_of(const ImageLayout& layout, const PatchBelow& patch, const Point& p) const {
    if (p.corner >= 0) return {p.vertex, p.weights, place_in(patch, layout.image.corners[p.corner])};
    const VertexId vertices = static_cast<VertexId>(mesh_.positions.size());
    if (p.vertex < vertices) return {p.vertex, p.weights, place_in(patch, p.at)};
    // A cut of an edge, the same from both sides: between the exact places of its ends, from the lower one.
    const CutPoint& cut = cuts_.points()[p.vertex - vertices];
    const auto& corners = mesh_.triangles[layout.source];
    const auto place_of = [&](VertexId v) {
      return place_in(patch, layout.image.corners[std::find(corners.begin(), corners.end(), v) - corners.begin()]);
    };
    const Vec2d from = place_of(cut.ends[0]);
    return {p.vertex, p.weights, from + (place_of(cut.ends[1]) - from) * cut.share};
  }

  const SourceMesh& mesh_;
  const EdgeCuts& cuts_;
};

/// How far a triangle is from a needle: its area by its longest side's square.
double roundness(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const double longest = std::max({(b - a).length2(), (c - b).length2(), (a - c).length2()});
  return longest > 0 ? (b - a).cross(c - a) / longest : 0;
}

/// Of a convex polygon, so that the worst triangle is as round as can be. [i][j] of the tables: the polygon from i to
/// j.
void PieceMaker::triangulate(const ImageLayout& layout, const PatchBelow& patch, const std::vector<Point>& piece,
                             std::vector<CutTriangle>& triangles) const {
  const std::size_t n = piece.size();
  std::vector<double> worst(n * n, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> apex(n * n, 0);
  for (std::size_t span = 2; span < n; ++span) {
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      worst[i * n + j] = -std::numeric_limits<double>::infinity();
      for (std::size_t k = i + 1; k < j; ++k) {
        const double here =
            std::min({worst[i * n + k], worst[k * n + j], roundness(piece[i].at, piece[k].at, piece[j].at)});
        if (here > worst[i * n + j]) {
          worst[i * n + j] = here;
          apex[i * n + j] = k;
        }
      }
    }
  }
  std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = apex[i * n + j];
    triangles.push_back(
        {layout.source,
         patch.patch,
         {corner_of(layout, patch, piece[i]), corner_of(layout, patch, piece[k]), corner_of(layout, patch, piece[j])}});
    open.push_back({k, j});
    open.push_back({i, k});
  }
}

}  // namespace

CutPieces pieces_of(const SourceMesh& mesh, const EdgeCuts& cuts, const ImageLayout& layout) {
  return PieceMaker(mesh, cuts).run(layout);
}

}  // namespace lozenge
