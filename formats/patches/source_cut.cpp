// For each triangle whose image isn't in one patch: the domain is laid out flat under it, and where its edges cross the
// borders of patches (the segments from a domain triangle's barycentre to its corners) is found once for each edge. The
// points of the triangle are then its corners, the cuts of its edges, and the corners of patches inside of it. A
// patch's part of the image is convex, and its corners are those of the points that lie in the patch; sorted around
// their middle they are the piece.
#include "formats/patches/source_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/unfolding.h"

namespace lozenge {

namespace {

/// What is nearer than this (in sides of a domain triangle) is in one place: a thousand steps of the lattice.
constexpr double kTogether = 1e-9;

/// A patch, laid out under an image.
struct PatchBelow {
  std::int32_t patch = -1;
  LatticeMotion from_home;  ///< from the frame of the image's home into the patch's
  bool is_half = false;     ///< only v >= u of its square exists

  friend bool operator==(const PatchBelow& a, const PatchBelow& b) {
    return a.patch == b.patch && a.from_home.sixths == b.from_home.sixths && a.from_home.shift == b.from_home.shift;
  }
};

/// A point of a frame in sides of a domain triangle, along the frame's two axes.
Vec2d in_sides(LatticePoint p) {
  constexpr double kStep = 1.0 / static_cast<double>(kLatticeOne);
  return {static_cast<double>(p.u) * kStep, static_cast<double>(p.v) * kStep};
}

Vec2d rotated_by(Vec2d p, int sixths) {
  for (int i = 0; i < sixths; ++i) p = {-p.y, p.x + p.y};
  return p;
}

Vec2d moved(const LatticeMotion& motion, const Vec2d& p) {
  return rotated_by(p, motion.sixths) + in_sides(motion.shift);
}

/// Where a point of the home's frame lies in the patch's square.
Vec2d place_in(const PatchBelow& patch, const Vec2d& p) {
  const Vec2d q = moved(patch.from_home, p);
  return {q.x - q.y, q.x + 2 * q.y};
}

/// The same of a point of the lattice: exact but for one rounding, so that all triangles around a vertex agree.
Vec2d place_in(const PatchBelow& patch, LatticePoint p) { return in_sides(in_square(patch.from_home(p))); }

bool holds(const PatchBelow& patch, const Vec2d& place, double slack) {
  return place.x >= -slack && place.y >= -slack && place.x <= 1 + slack && place.y <= 1 + slack &&
         (!patch.is_half || place.y >= place.x - slack);
}

/// An image, and what it lies on.
struct Layout {
  TriangleId source = -1;
  Development image;
  std::vector<UnfoldedTriangle> triangles;
  std::vector<PatchBelow> patches;
};

/// Three times a point of a domain triangle's frame, in the home's: barycentres are points of that lattice.
LatticePoint thrice(const LatticeMotion& into_home, LatticePoint three_times) {
  const LatticePoint shift = into_home.shift;
  return rotated(three_times, into_home.sixths) + LatticePoint{3 * shift.u, 3 * shift.v};
}

/// A border between patches: from the barycentre of a domain triangle to one of its corners, three times as large.
struct Spoke {
  LatticePoint barycentre;
  LatticePoint corner;
};

template <typename Visit>
void for_each_spoke(const Layout& layout, const Visit& visit) {
  static constexpr std::array<LatticePoint, 3> kCorners{LatticePoint{0, 0}, LatticePoint{3 * kLatticeOne, 0},
                                                        LatticePoint{0, 3 * kLatticeOne}};
  for (const UnfoldedTriangle& t : layout.triangles) {
    const LatticePoint barycentre = thrice(t.into_home, {kLatticeOne, kLatticeOne});
    for (const LatticePoint corner : kCorners) visit(Spoke{barycentre, thrice(t.into_home, corner)});
  }
}

LatticePoint times_three(LatticePoint p) { return {3 * p.u, 3 * p.v}; }

/// The share of the way from p to q where a spoke is crossed, or nothing.
std::optional<double> crossing(const Spoke& spoke, LatticePoint p, LatticePoint q) {
  const LatticeArea at_p = doubled_area(spoke.barycentre, spoke.corner, times_three(p));
  const LatticeArea at_q = doubled_area(spoke.barycentre, spoke.corner, times_three(q));
  if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) return std::nullopt;
  const double share = static_cast<double>(at_p) / static_cast<double>(at_p - at_q);
  const Vec2d start = in_sides(times_three(p));
  const Vec2d at = start + (in_sides(times_three(q)) - start) * share - in_sides(spoke.barycentre);
  const Vec2d along = in_sides(spoke.corner - spoke.barycentre);
  const double reach = at.dot(along) / along.length2();
  if (!(reach >= -kTogether && reach <= 1 + kTogether)) return std::nullopt;
  return share;
}

using Edge = std::array<VertexId, 2>;
struct EdgeHash {
  std::size_t operator()(const Edge& e) const {
    return std::hash<std::uint64_t>()(static_cast<std::uint64_t>(e[0]) << 32 | static_cast<std::uint32_t>(e[1]));
  }
};

/// The cuts of an edge: consecutive cut points, by rising share.
struct EdgeCuts {
  std::int32_t first = 0;
  std::int32_t count = 0;
};
using CutsOfEdges = std::unordered_map<Edge, EdgeCuts, EdgeHash>;

/// A point of a source triangle.
struct Point {
  VertexId vertex = -1;
  Vec2d at;  ///< in the home's frame
  Vec3d weights;
  int corner = -1;  ///< of the image, where it is one
};

class Cutter {
 public:
  Cutter(const SourceMesh& mesh, const Parameterization& map, const std::vector<PatchPlace>& places)
      : mesh_(mesh), map_(map), places_(places), halves_(patch_halves(places)) {}

  CutSurface run() {
    find_layouts();
    for (const Layout& layout : straddling_) cut_edges(layout);
    make_pieces();
    return std::move(result_);
  }

 private:
  // ---- Which triangles lie in more than one patch

  void find_layouts() {
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const std::size_t count = mesh_.triangles.size();
    whole_.resize(count);
    std::vector<std::vector<Layout>> found((count + kPart - 1) / kPart);
    std::vector<std::size_t> broken(found.size(), kNone);
    for_each_part(count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const auto image = image_of(mesh_, map_, static_cast<TriangleId>(t));
        if (!image) {
          broken[begin / kPart] = t;
          return;
        }
        if (auto triangle = uncut(static_cast<TriangleId>(t), *image)) whole_[t] = *triangle;
        else found[begin / kPart].push_back(layout_of(static_cast<TriangleId>(t), *image));
      }
    });
    for (const std::size_t t : broken) {
      if (t != kNone) {
        throw Error(ExitCode::kUnusableInput, mesh_.origin + ": triangle " + std::to_string(t) +
                                                  " has no image on the domain; make the map again");
      }
    }
    for (std::vector<Layout>& part : found) std::move(part.begin(), part.end(), std::back_inserter(straddling_));
  }

  /// The triangle as it is, where one patch of its home holds all of its image.
  std::optional<CutTriangle> uncut(TriangleId t, const Development& image) const {
    for (int side = 0; side < 3; ++side) {
      const PatchBelow patch = below({image.home, {}}, side);
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

  PatchBelow below(const UnfoldedTriangle& t, int side) const {
    const PatchHalf half = halves_[3 * static_cast<std::size_t>(t.triangle) + side];
    return {half.patch, composed(into_patch(side, half.left), inverse(t.into_home)),
            !places_[half.patch].right.exists()};
  }

  Layout layout_of(TriangleId t, const Development& image) const {
    Layout layout{t, image, unfold(map_.domain, image), {}};
    for (const UnfoldedTriangle& triangle : layout.triangles) {
      for (int side = 0; side < 3; ++side) {
        const PatchBelow patch = below(triangle, side);
        if (std::find(layout.patches.begin(), layout.patches.end(), patch) == layout.patches.end()) {
          layout.patches.push_back(patch);
        }
      }
    }
    return layout;
  }

  // ---- Where edges are cut

  static Edge edge_of(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

  /// The first triangle that has an edge cuts it.
  void cut_edges(const Layout& layout) {
    const auto& corners = mesh_.triangles[layout.source];
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      const Edge edge = edge_of(corners[c], corners[next]);
      const auto [entry, is_new] = cuts_.try_emplace(edge);
      if (!is_new) continue;
      const bool forward = corners[c] == edge[0];
      const LatticePoint p = layout.image.corners[forward ? c : next];
      const LatticePoint q = layout.image.corners[forward ? next : c];
      entry->second = add_cuts(edge, shares_of_cuts(layout, p, q), (in_sides(q) - in_sides(p)).length());
    }
  }

  static std::vector<double> shares_of_cuts(const Layout& layout, LatticePoint p, LatticePoint q) {
    std::vector<double> shares;
    for_each_spoke(layout, [&](const Spoke& spoke) {
      if (const auto share = crossing(spoke, p, q)) shares.push_back(*share);
    });
    std::sort(shares.begin(), shares.end());
    return shares;
  }

  /// Cuts in one place are one, and one in a vertex is none.
  EdgeCuts add_cuts(const Edge& edge, const std::vector<double>& shares, double length) {
    const double together = kTogether / length;
    EdgeCuts cuts{static_cast<std::int32_t>(result_.points.size()), 0};
    double last = 0;
    for (const double share : shares) {
      if (share - last <= together || 1 - share <= together) continue;
      result_.points.push_back({edge, share});
      ++cuts.count;
      last = share;
    }
    return cuts;
  }

  // ---- The pieces

  struct Made {
    std::vector<CutTriangle> triangles;
    std::int32_t inner_points = 0;
    std::int64_t cut = 0;
  };

  void make_pieces() {
    std::vector<Made> made(straddling_.size());
    for_each_part(straddling_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) made[i] = pieces_of(straddling_[i]);
    });
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
  void add(Made made) {
    const auto first = static_cast<VertexId>(mesh_.positions.size() + result_.points.size());
    for (CutTriangle& triangle : made.triangles) {
      for (CutCorner& corner : triangle.corners) {
        if (corner.vertex < 0) corner.vertex = first + (-1 - corner.vertex);
      }
      result_.triangles.push_back(triangle);
    }
    result_.points.resize(result_.points.size() + static_cast<std::size_t>(made.inner_points));
    result_.cut += made.cut;
  }

  Made pieces_of(const Layout& layout) const {
    Made made;
    std::vector<Point> points = points_of(layout);
    const std::size_t on_rim = points.size();
    add_inner_points(layout, points);
    made.inner_points = static_cast<std::int32_t>(points.size() - on_rim);
    for (const PatchBelow& patch : layout.patches) {
      const std::vector<Point> piece = piece_in(patch, points);
      if (piece.size() >= 3) triangulate(layout, patch, piece, made.triangles);
    }
    made.cut = made.triangles.size() > 1;
    return made;
  }

  /// Corners and cuts of the edges, counter-clockwise.
  std::vector<Point> points_of(const Layout& layout) const {
    std::vector<Point> points;
    const auto& corners = mesh_.triangles[layout.source];
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      Vec3d weights(0, 0, 0);
      weights[c] = 1;
      points.push_back({corners[c], in_sides(layout.image.corners[c]), weights, c});
      const Edge edge = edge_of(corners[c], corners[next]);
      const EdgeCuts& cuts = cuts_.at(edge);
      const bool forward = corners[c] == edge[0];
      const int low = forward ? c : next;
      const int high = forward ? next : c;
      for (std::int32_t k = 0; k < cuts.count; ++k) {
        const std::int32_t point = cuts.first + (forward ? k : cuts.count - 1 - k);
        const double share = result_.points[point].share;
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
  static void add_inner_points(const Layout& layout, std::vector<Point>& points) {
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
        if (across <= kTogether * side.length()) return;
        weights[c] = across / area;
      }
      const auto is_here = [&](const Point& other) { return (other.at - p).length2() < kTogether * kTogether; };
      if (std::any_of(points.begin(), points.end(), is_here)) return;
      points.push_back({-1 - static_cast<VertexId>(points.size() - first), p, weights, -1});
    };
    for_each_spoke(layout, [&](const Spoke& spoke) {
      add(spoke.barycentre);
      add(spoke.corner);
    });
  }

  /// The points that lie in a patch, counter-clockwise; fewer than three, or without area, where it has none of the
  /// image.
  static std::vector<Point> piece_in(const PatchBelow& patch, const std::vector<Point>& points) {
    constexpr double kSlack = 4 * kTogether;
    std::vector<Point> piece;
    Vec2d middle(0, 0);
    for (const Point& p : points) {
      if (!holds(patch, place_in(patch, p.at), kSlack)) continue;
      piece.push_back(p);
      middle += p.at;
    }
    if (piece.size() < 3) return {};
    middle /= static_cast<double>(piece.size());
    const auto angle = [&](const Point& p) { return std::atan2(p.at.y - middle.y, p.at.x - middle.x); };
    std::stable_sort(piece.begin(), piece.end(), [&](const Point& a, const Point& b) { return angle(a) < angle(b); });
    double area = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      area += (piece[i].at - middle).cross(piece[(i + 1) % piece.size()].at - middle);
    }
    if (!(area > kTogether * kTogether)) return {};
    return piece;
  }

  void triangulate(const Layout& layout, const PatchBelow& patch, const std::vector<Point>& piece,
                   std::vector<CutTriangle>& triangles) const;

  CutCorner corner_of(const Layout& layout, const PatchBelow& patch, const Point& p) const {
    if (p.corner >= 0) return {p.vertex, p.weights, place_in(patch, layout.image.corners[p.corner])};
    const VertexId vertices = static_cast<VertexId>(mesh_.positions.size());
    if (p.vertex < vertices) return {p.vertex, p.weights, place_in(patch, p.at)};
    // A cut of an edge, the same from both sides: between the exact places of its ends, from the lower one.
    const CutPoint& cut = result_.points[p.vertex - vertices];
    const auto& corners = mesh_.triangles[layout.source];
    const auto place_of = [&](VertexId v) {
      return place_in(patch, layout.image.corners[std::find(corners.begin(), corners.end(), v) - corners.begin()]);
    };
    const Vec2d from = place_of(cut.ends[0]);
    return {p.vertex, p.weights, from + (place_of(cut.ends[1]) - from) * cut.share};
  }

  const SourceMesh& mesh_;
  const Parameterization& map_;
  const std::vector<PatchPlace>& places_;
  std::vector<PatchHalf> halves_;
  std::vector<CutTriangle> whole_;  ///< [source triangle] itself, where it isn't cut
  std::vector<Layout> straddling_;  ///< the others
  CutsOfEdges cuts_;
  CutSurface result_;
};

/// How far a triangle is from a needle: its area by its longest side's square.
double roundness(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const double longest = std::max({(b - a).length2(), (c - b).length2(), (a - c).length2()});
  return longest > 0 ? (b - a).cross(c - a) / longest : 0;
}

/// Of a convex polygon, so that the worst triangle is as round as can be. [i][j] of the tables: the polygon from i to
/// j.
void Cutter::triangulate(const Layout& layout, const PatchBelow& patch, const std::vector<Point>& piece,
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

CutSurface cut_along_patches(const SourceMesh& mesh, const Parameterization& map,
                             const std::vector<PatchPlace>& places) {
  return Cutter(mesh, map, places).run();
}

}  // namespace lozenge
