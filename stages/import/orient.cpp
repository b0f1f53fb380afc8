#include "stages/import/orient.h"

#include <algorithm>
#include <utility>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/surface_facts.h"

namespace lozenge {

namespace {

/// Which triangles are to be turned, over the links of their half-edges.
class Turns {
 public:
  Turns(const SourceMesh& mesh, const std::vector<HalfEdge>& twins)
      : mesh_(mesh), twins_(twins), turned_(mesh.triangles.size(), false) {}

  std::vector<bool> find() {
    spread();
    shorten_cuts();
    let_the_larger_side_stay();
    return std::move(turned_);
  }

 private:
  /// Of the triangle across, -1 where there is none or too many.
  TriangleId neighbour(HalfEdge h) const {
    const HalfEdge twin = twins_[h];
    if (is_same_direction_twin(twin)) return same_direction_twin(twin) / 3;
    return twin < 0 ? -1 : twin / 3;
  }
  /// Whether the two triangles at an edge agree, once turned.
  bool agree(HalfEdge h) const {
    return (turned_[h / 3] == turned_[neighbour(h)]) != is_same_direction_twin(twins_[h]);
  }

  /// Breadth-first from the first triangle of each patch.
  void spread() {
    std::vector<bool> seen(turned_.size(), false);
    std::vector<TriangleId> queue;
    for (TriangleId seed = 0; seed < static_cast<TriangleId>(turned_.size()); ++seed) {
      if (seen[seed]) continue;
      seen[seed] = true;
      queue.assign(1, seed);
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const TriangleId t = queue[i];
        for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
          const TriangleId u = neighbour(h);
          if (u < 0 || seen[u]) continue;
          seen[u] = true;
          turned_[u] = turned_[t] != is_same_direction_twin(twins_[h]);
          queue.push_back(u);
        }
      }
    }
  }

  /// A triangle that disagrees with most of its neighbours is turned: each time the cuts lose an edge at least.
  void shorten_cuts() {
    std::vector<TriangleId> open;
    for (HalfEdge h = 0; h < static_cast<HalfEdge>(twins_.size()); ++h) {
      if (neighbour(h) >= 0 && !agree(h)) open.push_back(h / 3);
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
      const TriangleId t = open[i];
      int balance = 0;
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (neighbour(h) >= 0) balance += agree(h) ? 1 : -1;
      }
      if (balance >= 0) continue;
      turned_[t] = !turned_[t];
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (neighbour(h) >= 0 && !agree(h)) open.push_back(neighbour(h));
      }
    }
  }

  /// Whether a piece whose turned triangles have this area is to be turned as a whole.
  bool faces_the_wrong_way(const std::vector<TriangleId>& piece, double turned_area, double kept_area) const {
    // Where triangles were turned at random, the areas say nothing.
    constexpr double kClear = 2;
    const bool clear = std::max(turned_area, kept_area) >= kClear * std::min(turned_area, kept_area);
    if (clear || !is_closed(piece)) return turned_area > kept_area;
    return volume(piece) < 0;
  }

  bool is_closed(const std::vector<TriangleId>& piece) const {
    return std::all_of(piece.begin(), piece.end(), [&](TriangleId t) {
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        if (neighbour(h) < 0 || !agree(h)) return false;
      }
      return true;
    });
  }

  /// Six times what a closed piece encloses.
  double volume(const std::vector<TriangleId>& piece) const {
    const Vec3d origin(mesh_.positions[mesh_.triangles[piece.front()][0]]);
    double sum = 0;
    for (const TriangleId t : piece) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const Vec3d p = Vec3d(mesh_.positions[a]) - origin;
      const Vec3d q = Vec3d(mesh_.positions[b]) - origin;
      const Vec3d r = Vec3d(mesh_.positions[c]) - origin;
      sum += (turned_[t] ? -1 : 1) * p.dot(q.cross(r));
    }
    return sum;
  }

  void let_the_larger_side_stay() {
    std::vector<bool> seen(turned_.size(), false);
    std::vector<TriangleId> piece;
    for (TriangleId seed = 0; seed < static_cast<TriangleId>(turned_.size()); ++seed) {
      if (seen[seed]) continue;
      seen[seed] = true;
      piece.assign(1, seed);
      double turned_area = 0;
      double kept_area = 0;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const TriangleId t = piece[i];
        (turned_[t] ? turned_area : kept_area) += triangle_area(mesh_.positions, mesh_.triangles[t]);
        for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
          const TriangleId u = neighbour(h);
          if (u < 0 || seen[u] || !agree(h)) continue;
          seen[u] = true;
          piece.push_back(u);
        }
      }
      if (!faces_the_wrong_way(piece, turned_area, kept_area)) continue;
      for (const TriangleId t : piece) turned_[t] = !turned_[t];
    }
  }

  const SourceMesh& mesh_;
  const std::vector<HalfEdge>& twins_;
  std::vector<bool> turned_;
};

void turn_over(SourceMesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const Vec3d p(mesh.positions[a]);
  const Vec3d outside = (Vec3d(mesh.positions[b]) - p).cross(Vec3d(mesh.positions[c]) - p);
  turn_triangle(mesh.corner_attributes, static_cast<TriangleId>(t), outside);
  std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

}  // namespace

void orient_patches(SourceMesh& mesh, RepairReport& report) {
  const std::vector<HalfEdge> twins = link_half_edges(mesh).twins;
  if (std::none_of(twins.begin(), twins.end(), is_same_direction_twin)) return;
  const std::vector<bool> turned = Turns(mesh, twins).find();
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (!turned[t]) continue;
    report.add(RepairKind::kTurnedTriangles, mesh.positions[mesh.triangles[t][0]]);
    turn_over(mesh, t);
  }
}

}  // namespace lozenge
