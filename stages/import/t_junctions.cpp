// Edges of one triangle are sought for vertices of other such edges that lie on them and go on along them. A triangle
// whose sides got vertices is cut from the corner opposite of the side that got most, like a fan; its first and last
// piece have the other sides, and are cut in turn.
#include "stages/import/t_junctions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/canonical_form.h"
#include "formats/surface/surface_facts.h"
#include "stages/import/leave_out.h"
#include "stages/import/points_on_segments.h"

namespace lozenge {

namespace {

/// A vertex is on an edge where it is no farther away than a millionth of the edge's length: exporters that cut long
/// edges at even coordinates are exact, those that scale and turn afterwards round.
constexpr double kOfLength = 1e-6;
/// Or than what rounding coordinates to floats takes.
constexpr double kOfCoordinates = 0x1p-23;

/// Where thousands of edges lie on each other, each has the others' vertices, and there is nothing sensible to join:
/// after so many looks, or so many vertices an edge in the mean, the surface stays as it is.
constexpr std::int64_t kMostLooks = 200'000'000;
constexpr std::size_t kMostOfEdge = 16;

/// A vertex on a side of a triangle.
struct OnSide {
  double share = 0;  ///< of the way along the side
  VertexId vertex = -1;
};
/// [half-edge], by rising share
using VerticesOnSides = std::map<HalfEdge, std::vector<OnSide>>;

/// The edges that have one triangle.
class OpenEdges {
 public:
  explicit OpenEdges(const SourceMesh& mesh) : mesh_(mesh) {
    const HalfEdgeLinks links = link_half_edges(mesh);
    for (std::size_t h = 0; h < links.twins.size(); ++h) {
      const auto edge = static_cast<HalfEdge>(h);
      if (links.twins[h] == kNoTwin && !is_flat(mesh, edge / 3)) edges_.push_back(edge);
    }
  }

  bool empty() const { return edges_.empty(); }

  VerticesOnSides find() {
    std::vector<Segment> segments;
    for (const HalfEdge h : edges_) segments.push_back(segment_of(h));
    list_ends();
    std::vector<Vec3d> points;
    for (const VertexId v : vertices_) points.emplace_back(mesh_.positions[v]);
    VerticesOnSides found;
    std::int64_t looks = 0;
    std::size_t pairs = 0;
    const bool came_to_its_end = for_each_point_near_segments(segments, points, [&](std::int32_t s, std::int32_t p) {
      if (++looks > kMostLooks) return false;
      const double share = share_on_segment(segments[s], points[p]);
      if (share < 0 || !goes_along(vertices_[p], edges_[s], segments[s])) return true;
      found[edges_[s]].push_back({share, vertices_[p]});
      return ++pairs <= kMostOfEdge * edges_.size();
    });
    if (!came_to_its_end) return {};
    for (auto& [side, on_side] : found) {
      std::sort(on_side.begin(), on_side.end(), [](const OnSide& a, const OnSide& b) {
        return a.share != b.share ? a.share < b.share : a.vertex < b.vertex;
      });
    }
    return found;
  }

 private:
  struct End {
    VertexId vertex;
    HalfEdge edge;
  };

  Segment segment_of(HalfEdge h) const {
    Segment segment{Vec3d(mesh_.positions[half_edge_start(mesh_, h)]), Vec3d(mesh_.positions[half_edge_end(mesh_, h)]),
                    0};
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(segment.start[i]), std::abs(segment.end[i])});
    segment.tolerance = std::max(kOfLength * (segment.end - segment.start).length(), kOfCoordinates * largest);
    return segment;
  }

  /// Which open edges end in a vertex; by vertices.
  void list_ends() {
    for (const HalfEdge h : edges_) {
      ends_.push_back({half_edge_start(mesh_, h), h});
      ends_.push_back({half_edge_end(mesh_, h), h});
    }
    std::sort(ends_.begin(), ends_.end(),
              [](const End& a, const End& b) { return a.vertex != b.vertex ? a.vertex < b.vertex : a.edge < b.edge; });
    for (const End& end : ends_) {
      if (vertices_.empty() || vertices_.back() != end.vertex) vertices_.push_back(end.vertex);
    }
  }

  /// Whether an open edge of the same surface leaves the vertex along this one.
  bool goes_along(VertexId v, HalfEdge edge, const Segment& segment) const {
    const auto& corners = mesh_.triangles[edge / 3];
    if (std::find(corners.begin(), corners.end(), v) != corners.end()) return false;
    auto end = std::lower_bound(ends_.begin(), ends_.end(), v,
                                [](const End& each, VertexId vertex) { return each.vertex < vertex; });
    for (; end != ends_.end() && end->vertex == v; ++end) {
      if (owner_of(end->edge / 3) == owner_of(edge / 3) && lie_along(end->edge, v, edge, segment)) return true;
    }
    return false;
  }

  /// Whether an edge that ends in a vertex of another one has more in common with it: its other end lies there, too, or
  /// the other edge ends on it.
  bool lie_along(HalfEdge leaving, VertexId v, HalfEdge edge, const Segment& segment) const {
    const VertexId start = half_edge_start(mesh_, leaving);
    const VertexId other = start == v ? half_edge_end(mesh_, leaving) : start;
    const std::array<VertexId, 2> ends{half_edge_start(mesh_, edge), half_edge_end(mesh_, edge)};
    if (other == ends[0] || other == ends[1] || share_on_segment(segment, Vec3d(mesh_.positions[other])) >= 0)
      return true;
    const Segment way = segment_of(leaving);
    return std::any_of(ends.begin(), ends.end(),
                       [&](VertexId end) { return share_on_segment(way, Vec3d(mesh_.positions[end])) >= 0; });
  }

  /// Surfaces of different bodies are never joined.
  std::int32_t owner_of(TriangleId t) const {
    return mesh_.materials.empty() ? -1 : mesh_.bodies.owner_of(mesh_.materials[t]);
  }

  const SourceMesh& mesh_;
  std::vector<HalfEdge> edges_;
  std::vector<End> ends_;
  std::vector<VertexId> vertices_;  ///< at the ends of open edges, ascending
};

/// A corner of a piece: a vertex, and the share of each of the triangle's corners in it.
struct PieceCorner {
  VertexId vertex = -1;
  std::array<double, 3> weights{};
};

/// A part of a triangle that is still to be cut: [corner], and [side] from it to the next, the vertices on it in order.
struct Piece {
  std::array<PieceCorner, 3> corners;
  std::array<std::vector<PieceCorner>, 3> on_side;
};

class TriangleCutter {
 public:
  explicit TriangleCutter(SourceMesh& mesh) : mesh_(mesh) {}

  /// Appends what the triangle becomes.
  void cut(TriangleId t, const VerticesOnSides& on_sides) {
    std::vector<Piece> open{whole(t, on_sides)};
    while (!open.empty()) {
      const Piece piece = std::move(open.back());
      open.pop_back();
      const auto most = std::max_element(piece.on_side.begin(), piece.on_side.end(),
                                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
      if (most->empty()) append(t, piece.corners);
      else fan_out(t, piece, static_cast<int>(most - piece.on_side.begin()), open);
    }
  }

 private:
  Piece whole(TriangleId t, const VerticesOnSides& on_sides) const {
    Piece piece;
    std::vector<VertexId> used(mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    for (int c = 0; c < 3; ++c) {
      piece.corners[c].vertex = mesh_.triangles[t][c];
      piece.corners[c].weights[c] = 1;
      const auto found = on_sides.find(3 * t + c);
      if (found == on_sides.end()) continue;
      for (const OnSide& on_side : found->second) {
        // At a sharp corner a vertex may be near enough to both sides.
        if (std::find(used.begin(), used.end(), on_side.vertex) != used.end()) continue;
        used.push_back(on_side.vertex);
        PieceCorner corner{on_side.vertex, {}};
        corner.weights[c] = 1 - on_side.share;
        corner.weights[(c + 1) % 3] = on_side.share;
        piece.on_side[c].push_back(corner);
      }
    }
    return piece;
  }

  void fan_out(TriangleId t, const Piece& piece, int side, std::vector<Piece>& open) {
    const PieceCorner& apex = piece.corners[(side + 2) % 3];
    std::vector<PieceCorner> rim{piece.corners[side]};
    rim.insert(rim.end(), piece.on_side[side].begin(), piece.on_side[side].end());
    rim.push_back(piece.corners[(side + 1) % 3]);
    for (std::size_t i = 0; i + 1 < rim.size(); ++i) {
      const bool is_first = i == 0;
      const bool is_last = i + 2 == rim.size();
      Piece slice{{rim[i], rim[i + 1], apex}, {}};
      if (is_last) slice.on_side[1] = piece.on_side[(side + 1) % 3];
      if (is_first) slice.on_side[2] = piece.on_side[(side + 2) % 3];
      if (is_first || is_last) open.push_back(std::move(slice));
      else append(t, slice.corners);
    }
  }

  void append(TriangleId t, const std::array<PieceCorner, 3>& corners) {
    for (const PieceCorner& corner : corners) {
      std::vector<WeightedElement> parts;
      for (int c = 0; c < 3; ++c) {
        if (corner.weights[c] > 0) parts.push_back({static_cast<std::size_t>(3 * t + c), corner.weights[c]});
      }
      if (parts.size() == 1) append_element(mesh_.corner_attributes, mesh_.corner_attributes, parts.front().element);
      else append_element(mesh_.corner_attributes, interpolated(mesh_.corner_attributes, parts), 0);
    }
    mesh_.triangles.push_back({corners[0].vertex, corners[1].vertex, corners[2].vertex});
    if (!mesh_.materials.empty()) mesh_.materials.push_back(mesh_.materials[t]);
  }

  SourceMesh& mesh_;
};

}  // namespace

void join_t_junctions(SourceMesh& mesh, RepairReport& report) {
  OpenEdges edges(mesh);
  if (edges.empty()) return;
  const VerticesOnSides on_sides = edges.find();
  if (on_sides.empty()) return;
  std::vector<bool> keep(mesh.triangles.size(), true);
  TriangleCutter cutter(mesh);
  for (const auto& [side, vertices] : on_sides) {
    for (const OnSide& on_side : vertices) report.add(RepairKind::kTJunctions, mesh.positions[on_side.vertex]);
    const TriangleId t = side / 3;
    if (!keep[t]) continue;
    keep[t] = false;
    cutter.cut(t, on_sides);
  }
  keep.resize(mesh.triangles.size(), true);
  leave_out(mesh, keep);
  make_canonical(mesh);
}

}  // namespace lozenge
