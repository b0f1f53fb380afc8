// The longest edge is split in its middle, and with it the one or two triangles at it; what that leaves too long waits
// in the queue with the others. Splitting longest first keeps triangles from becoming thinner than the source's.
#include "stages/parameterize/levels/split_long_edges.h"

#include <algorithm>
#include <array>
#include <queue>
#include <string>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/canonical_form.h"
#include "stages/parameterize/map/halfedge_mesh.h"

namespace lozenge {

namespace {

double squared_length(const SourceMesh& mesh, VertexId a, VertexId b) {
  return (Vec3d(mesh.positions[a]) - Vec3d(mesh.positions[b])).length2();
}

/// An edge inside between two vertices of the boundary.
bool is_chord(const HalfedgeMesh& mesh, Halfedge h) {
  return mesh.twins[h] >= 0 && mesh.on_boundary(mesh.start(h)) && mesh.on_boundary(mesh.end(h));
}

/// Whether an edge's middle can be given so exactly that the surface stays what it was, and that its halves are
/// shorter: far from the origin, what lies between two coordinates may be one of them.
bool has_middle(const Vec3f& a, const Vec3f& b) {
  constexpr double kOff = 1 / 16.0;
  const Vec3d off = Vec3d(middle_of_edge(a, b)) - (Vec3d(a) + Vec3d(b)) / 2;
  return off.length() <= kOff * (Vec3d(a) - Vec3d(b)).length();
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
    while (!queue_.empty() && halfedges_.triangle_count() + 2 <= most_triangles) {
      const Entry e = queue_.top();
      queue_.pop();
      if (!is_named(e.halfedge) || length(e.halfedge) != e.length || !is_longest(e.halfedge)) continue;
      for (const Halfedge h : split(e.halfedge)) {
        if (h >= 0) push(is_named(h) ? h : halfedges_.twins[h], limit);
      }
    }
    return take();
  }

  SourceMesh run_chords() {
    // What a split appends is looked at in its turn; the new vertices lie inside.
    for (Halfedge h = 0; h < static_cast<Halfedge>(halfedges_.twins.size()); ++h) {
      if (is_chord(halfedges_, h)) split(h);
    }
    return take();
  }

  SourceMesh run(const std::vector<Halfedge>& edges) {
    for (const Halfedge h : edges) split(h);
    return take();
  }

 private:
  struct Entry {
    double length;  ///< squared
    Halfedge halfedge;
    bool operator<(const Entry& other) const {
      return length != other.length ? length < other.length : halfedge > other.halfedge;
    }
  };

  SourceMesh take() {
    mesh_.triangles = std::move(halfedges_.triangles);
    return std::move(mesh_);
  }

  /// An edge goes by its lower half-edge.
  bool is_named(Halfedge h) const { return halfedges_.twins[h] < 0 || halfedges_.twins[h] > h; }
  double length(Halfedge h) const { return squared_length(mesh_, halfedges_.start(h), halfedges_.end(h)); }
  /// Of its triangles' edges, as all are that come by length, but beside longer ones that have no middle. The line from
  /// the longest edge's middle to the opposite vertex is shorter than it; of another edge, splitting might never end.
  bool is_longest(Halfedge h) const {
    const auto in_triangle = [&](Halfedge side) {
      return side < 0 || std::max(length(next_in_triangle(side)), length(previous_in_triangle(side))) <= length(side);
    };
    return in_triangle(h) && in_triangle(halfedges_.twins[h]);
  }
  const Vec3f& position(VertexId v) const { return mesh_.positions[v]; }
  void push(Halfedge h, double limit) {
    const double l = length(h);
    if (l > limit && has_middle(position(halfedges_.start(h)), position(halfedges_.end(h)))) queue_.push({l, h});
  }

  /// Gives the two halves of what was the triangle of h their attributes; the second half is the mesh's last triangle.
  void halve_attributes(Halfedge h) {
    halve_triangle(mesh_.corner_attributes, static_cast<std::size_t>(h));
    if (!mesh_.materials.empty()) mesh_.materials.push_back(mesh_.materials[h / 3]);
  }

  /// \return a half-edge of every edge that is new or goes by another name now; -1 at a boundary
  std::array<Halfedge, 6> split(Halfedge h) {
    const Halfedge g = halfedges_.twins[h];
    mesh_.positions.push_back(middle_of_edge(position(halfedges_.start(h)), position(halfedges_.end(h))));
    const auto left = static_cast<Halfedge>(halfedges_.twins.size());
    split_edge(halfedges_, h);
    halve_attributes(h);
    std::array<Halfedge, 6> fresh{h, left, next_in_triangle(h), next_in_triangle(left), -1, -1};
    if (g >= 0) {
      halve_attributes(g);
      fresh[4] = next_in_triangle(g);
      fresh[5] = next_in_triangle(left + 3);
    }
    return fresh;
  }

  SourceMesh mesh_;
  HalfedgeMesh halfedges_;
  std::priority_queue<Entry> queue_;
};

}  // namespace

Vec3f middle_of_edge(const Vec3f& a, const Vec3f& b) {
  return without_negative_zeros(Vec3f((Vec3d(a) + Vec3d(b)) / 2));
}

SourceMesh split_long_edges(const SourceMesh& mesh, double longest, std::int64_t most_triangles,
                            std::vector<VertexId>* number_of) {
  SourceMesh split = Splitter(mesh).run(longest, most_triangles);
  std::vector<VertexId> numbers = make_canonical(split);
  if (number_of) *number_of = std::move(numbers);
  return split;
}

SourceMesh split_chords(const SourceMesh& mesh, std::vector<VertexId>* number_of) {
  SourceMesh split = Splitter(mesh).run_chords();
  std::vector<VertexId> numbers = make_canonical(split);
  if (number_of) *number_of = std::move(numbers);
  return split;
}

bool has_chord(const HalfedgeMesh& mesh) {
  for (Halfedge h = 0; h < static_cast<Halfedge>(mesh.twins.size()); ++h) {
    if (is_chord(mesh, h)) return true;
  }
  return false;
}

SourceMesh split_edges(const SourceMesh& mesh, const std::vector<Halfedge>& edges) { return Splitter(mesh).run(edges); }

bool has_longer_edge(const SourceMesh& mesh, double longest) {
  const double limit = longest * longest;
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    return squared_length(mesh, t[0], t[1]) > limit || squared_length(mesh, t[1], t[2]) > limit ||
           squared_length(mesh, t[2], t[0]) > limit;
  });
}

}  // namespace lozenge
