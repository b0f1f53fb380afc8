// Vertices are sorted along a curve through space and cut into blocks, each simplified on a thread of its own as far as
// it can be without its neighbours; a second round has its borders elsewhere. What is left of a large mesh is small
// enough for one thread, in arrays of its own.
#include "stages/parameterize/levels/simplify_in_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "formats/base/parallel.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/levels/proxy.h"
#include "stages/parameterize/levels/simplify.h"
#include "stages/parameterize/map/curve_order.h"

namespace lozenge {

namespace {

/// Vertices of a block in each round. The second one removes what lay between the blocks of the first.
constexpr std::array<std::int32_t, 2> kBlocks = {16384, 4096};
/// Blocks pay where the mesh has so many times the proxy's triangles.
constexpr std::int32_t kLeastRatio = 6;
/// Edges up to this share of the proxy's mean length are collapsed in blocks, longer ones with the whole in view.
constexpr double kShareOfLength = 0.5;

/// The vertices that are left, those near each other in space near each other in the list.
std::vector<VertexId> along_a_curve(const HalfedgeMesh& mesh, const std::vector<Vec3f>& positions) {
  const SpaceCurve curve(bounds_of(positions));
  std::vector<std::pair<std::uint32_t, VertexId>> codes;
  codes.reserve(positions.size());
  for (VertexId v = 0; v < static_cast<VertexId>(positions.size()); ++v) {
    if (mesh.outgoing[v] >= 0) codes.emplace_back(0, v);
  }
  for_each_part(codes.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) codes[i].first = curve.place_of(positions[codes[i].second]);
  });
  return numbers_by_key(std::move(codes));
}

/// Removes vertices in blocks along a curve through space. A vertex and the triangles around it belong to a block where
/// all its neighbours do; only such vertices are removed, or take a removed one's triangles, so blocks neither read nor
/// write what another one changes.
class Round {
 public:
  /// \param size  of the blocks, in vertices
  Round(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, const std::vector<char>& kept, std::size_t size)
      : mesh_(mesh), positions_(positions), order_(along_a_curve(mesh, positions)), size_(size) {
    find_inside();
    guard_.may_remove = [this, &kept](VertexId v) { return inside_[v] != 0 && kept[v] == 0; };
    guard_.may_grow = [this](VertexId v) { return inside_[v] != 0; };
  }

  /// Collapses edges shorter than `longest`.
  Blocks run(float longest) {
    Blocks blocks((order_.size() + size_ - 1) / size_);
    for_each_index(blocks.size(), true, [&](std::size_t b) {
      std::vector<VertexId> vertices;
      for (std::size_t i = b * size_; i < std::min(order_.size(), (b + 1) * size_); ++i) {
        if (inside_[order_[i]]) vertices.push_back(order_[i]);
      }
      blocks[b] = simplify_edges(mesh_, positions_, vertices, longest, guard_);
    });
    return blocks;
  }

 private:
  void find_inside() {
    std::vector<std::size_t> block(positions_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) block[order_[i]] = i / size_;
    inside_.assign(positions_.size(), 0);
    for_each_part(order_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const VertexId v = order_[i];
        inside_[v] = 1;
        for_each_neighbour(mesh_, v, [&](VertexId w) {
          if (block[w] != block[v]) inside_[v] = 0;
        });
      }
    });
  }

  HalfedgeMesh& mesh_;
  const std::vector<Vec3f>& positions_;
  std::vector<VertexId> order_;
  std::size_t size_;
  std::vector<char> inside_;  ///< [vertex]
  RemovalGuard guard_;
};

/// `simplify`, in arrays of what is left alone: near in memory, where that is little of a large mesh.
std::vector<Removal> simplify_what_is_left(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions,
                                           std::int32_t triangles, const std::vector<char>& kept) {
  Proxy left = extract_proxy(mesh, positions);
  RemovalGuard guard;
  guard.may_remove = [&](VertexId v) { return kept[left.vertices[v]] == 0; };
  std::vector<Removal> removals = simplify(left.mesh, left.positions, triangles, guard);
  write_back(left, mesh);
  for (Removal& r : removals) r = {left.in_whole(r.left), left.in_whole(r.right), left.vertices[r.vertex]};
  return removals;
}

}  // namespace

Hierarchy simplify_in_blocks(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, std::int32_t triangles,
                             const std::vector<VertexId>& keep) {
  Hierarchy hierarchy;
  std::vector<char> kept(positions.size(), 0);
  for (const VertexId v : keep) kept[v] = 1;
  // The side of an equilateral triangle of the proxy's mean area.
  const double side = std::sqrt(surface_area(positions, mesh.triangles) / triangles * 4 / std::sqrt(3.0));
  std::int32_t left = mesh.triangle_count();
  for (const std::int32_t size : kBlocks) {
    if (left / kLeastRatio <= triangles || left < 4 * size) continue;
    hierarchy.rounds.push_back(Round(mesh, positions, kept, size).run(static_cast<float>(side * kShareOfLength)));
    for (const std::vector<Removal>& block : hierarchy.rounds.back()) {
      for (const Removal& removal : block) left -= removal.triangles();
    }
  }
  hierarchy.coarser = simplify_what_is_left(mesh, positions, triangles, kept);
  return hierarchy;
}

}  // namespace lozenge
