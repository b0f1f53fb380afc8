#include "stages/parameterize/split_long_edges.h"

#include <algorithm>
#include <array>
#include <queue>
#include <string>

#include "formats/error.h"
#include "stages/parameterize/halfedge_mesh.h"

namespace lozenge {

namespace {

double squared_length(const SourceMesh& mesh, VertexId a, VertexId b) {
  return (Vec3d(mesh.positions[a]) - Vec3d(mesh.positions[b])).length2();
}

/// Triangles keep their number when they are split; the new half is appended.
class Splitter {
 public:
  explicit Splitter(const SourceMesh& mesh)
      : mesh_(mesh), halfedges_(make_halfedge_mesh(mesh.triangles, static_cast<std::int32_t>(mesh.positions.size()))) {}

  SourceMesh run(double longest, std::int64_t most_triangles) {
    const double limit = longest * longest;
    for (Halfedge h = 0; h < static_cast<Halfedge>(halfedges_.twins.size()); ++h) {
      if (is_named(h)) push(h, limit);
    }
    while (!queue_.empty()) {
      const Entry e = queue_.top();
      queue_.pop();
      if (!is_named(e.halfedge) || length(e.halfedge) != e.length) continue;
      if (halfedges_.triangle_count() + 2 > most_triangles) {
        throw Error(ExitCode::kLimit,
                    mesh_.origin +
                        ": its triangles are so large beside the domain's that splitting them makes more than " +
                        std::to_string(most_triangles) + "; ask for fewer domain triangles");
      }
      for (const Halfedge h : split(e.halfedge)) {
        if (h >= 0) push(is_named(h) ? h : halfedges_.twins[h], limit);
      }
    }
    mesh_.triangles = std::move(halfedges_.triangles);
    return std::move(mesh_);
  }

 private:
  struct Entry {
    double length;  ///< squared
    Halfedge halfedge;
    bool operator<(const Entry& other) const {
      return length != other.length ? length < other.length : halfedge > other.halfedge;
    }
  };

  /// An edge goes by its lower half-edge.
  bool is_named(Halfedge h) const { return halfedges_.twins[h] < 0 || halfedges_.twins[h] > h; }
  double length(Halfedge h) const { return squared_length(mesh_, halfedges_.start(h), halfedges_.end(h)); }
  void push(Halfedge h, double limit) {
    if (const double l = length(h); l > limit) queue_.push({l, h});
  }

  /// The middle of an edge, as a corner attribute of one of its triangles.
  template <typename T>
  static void append_half(std::vector<T>& corners, Halfedge h) {
    if (corners.empty()) return;
    const Halfedge n = next_in_triangle(h);
    const T middle = (corners[h] + corners[n]) * 0.5F;
    const T end = corners[n];
    const T opposite = corners[previous_in_triangle(h)];
    corners[n] = middle;
    corners.insert(corners.end(), {middle, end, opposite});
  }

  /// Cuts the triangle of h from the middle m of h to the corner opposite: (a, b, c) becomes (a, m, c), and (m, b, c)
  /// is appended. Half-edge h now runs from a to m, the new triangle's first from m to b.
  Halfedge cut_triangle(Halfedge h, VertexId m) {
    const auto t = static_cast<std::size_t>(h / 3);
    const Halfedge n = next_in_triangle(h);
    const VertexId b = halfedges_.end(h);
    const VertexId c = halfedges_.opposite(h);
    const auto first = static_cast<Halfedge>(halfedges_.twins.size());
    const Halfedge beyond = halfedges_.twins[n];
    halfedges_.triangles.push_back({m, b, c});
    halfedges_.twins.insert(halfedges_.twins.end(), {-1, beyond, n});
    if (beyond >= 0) halfedges_.twins[beyond] = first + 1;
    halfedges_.twins[n] = first + 2;
    halfedges_.triangles[t][n % 3] = m;
    append_half(mesh_.corner_normals, h);
    append_half(mesh_.corner_uvs, h);
    append_half(mesh_.corner_colors, h);
    if (!mesh_.materials.empty()) mesh_.materials.push_back(mesh_.materials[t]);
    return first;
  }

  /// \return a half-edge of every edge that is new or goes by another name now; -1 at a boundary
  std::array<Halfedge, 6> split(Halfedge h) {
    const Halfedge g = halfedges_.twins[h];
    const auto m = static_cast<VertexId>(mesh_.positions.size());
    const Vec3d middle = (Vec3d(mesh_.positions[halfedges_.start(h)]) + Vec3d(mesh_.positions[halfedges_.end(h)])) / 2;
    mesh_.positions.push_back(Vec3f(middle));
    const Halfedge left = cut_triangle(h, m);
    std::array<Halfedge, 6> fresh{h, left, next_in_triangle(h), next_in_triangle(left), -1, -1};
    if (g >= 0) {
      const Halfedge right = cut_triangle(g, m);
      halfedges_.twins[h] = right;
      halfedges_.twins[right] = h;
      halfedges_.twins[g] = left;
      halfedges_.twins[left] = g;
      fresh[4] = next_in_triangle(g);
      fresh[5] = next_in_triangle(right);
    }
    return fresh;
  }

  SourceMesh mesh_;
  HalfedgeMesh halfedges_;
  std::priority_queue<Entry> queue_;
};

template <typename T>
void reorder_corners(std::vector<T>& corners, const std::vector<TriangleId>& order) {
  if (corners.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(corners.size());
  for (const TriangleId t : order) {
    for (int c = 0; c < 3; ++c) sorted.push_back(corners[3 * static_cast<std::size_t>(t) + c]);
  }
  corners = std::move(sorted);
}

/// The form that SourceMesh promises: triangles by material, vertices by first use.
void make_canonical(SourceMesh& mesh) {
  std::vector<TriangleId> order(mesh.triangles.size());
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = static_cast<TriangleId>(t);
  if (!mesh.materials.empty()) {
    std::stable_sort(order.begin(), order.end(),
                     [&](TriangleId a, TriangleId b) { return mesh.materials[a] < mesh.materials[b]; });
    reorder_corners(mesh.corner_normals, order);
    reorder_corners(mesh.corner_uvs, order);
    reorder_corners(mesh.corner_colors, order);
    std::stable_sort(mesh.materials.begin(), mesh.materials.end());
  }
  std::vector<VertexId> number(mesh.positions.size(), -1);
  std::vector<Vec3f> positions;
  positions.reserve(mesh.positions.size());
  std::vector<std::array<VertexId, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const TriangleId t : order) {
    auto corners = mesh.triangles[t];
    for (VertexId& v : corners) {
      if (number[v] < 0) {
        number[v] = static_cast<VertexId>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
    triangles.push_back(corners);
  }
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
}

}  // namespace

SourceMesh split_long_edges(const SourceMesh& mesh, double longest, std::int64_t most_triangles) {
  SourceMesh split = Splitter(mesh).run(longest, most_triangles);
  make_canonical(split);
  return split;
}

bool has_longer_edge(const SourceMesh& mesh, double longest) {
  const double limit = longest * longest;
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return squared_length(mesh, t[0], t[1]) > limit || squared_length(mesh, t[1], t[2]) > limit ||
           squared_length(mesh, t[2], t[0]) > limit;
  });
}

}  // namespace lozenge
