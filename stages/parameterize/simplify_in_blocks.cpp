#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "formats/source_mesh.h"
#include "stages/parameterize/levels.h"
#include "stages/parameterize/parallel.h"

namespace lozenge {

namespace {

constexpr std::size_t kBlock = 16384;  // vertices
/// Blocks pay where the mesh has so many times the proxy's triangles.
constexpr std::int32_t kLeastRatio = 6;
/// Edges up to this share of the proxy's mean length are collapsed in blocks, longer ones with the whole in view.
constexpr double kShareOfLength = 0.5;

/// Interleaves the low 10 bits of three numbers: near points get near numbers (Morton's curve).
std::uint32_t interleaved(const std::array<std::uint32_t, 3>& cell) {
  std::uint32_t code = 0;
  for (int bit = 9; bit >= 0; --bit) {
    for (const std::uint32_t c : cell) code = (code << 1) | ((c >> bit) & 1);
  }
  return code;
}

std::vector<VertexId> along_a_curve(const std::vector<Vec3f>& positions) {
  const Bounds bounds = bounds_of(positions);
  const Vec3f size = bounds.high - bounds.low;
  const float longest = std::max({size.x, size.y, size.z, 1e-30F});
  std::vector<std::pair<std::uint32_t, VertexId>> codes(positions.size());
  for_each_part(codes.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3f p = (positions[v] - bounds.low) / longest;
      const auto cell = [](float x) { return static_cast<std::uint32_t>(std::clamp(x * 1023.0F, 0.0F, 1023.0F)); };
      codes[v] = {interleaved({cell(p.x), cell(p.y), cell(p.z)}), static_cast<VertexId>(v)};
    }
  });
  std::sort(codes.begin(), codes.end());
  std::vector<VertexId> order(codes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = codes[i].second;
  return order;
}

}  // namespace

Hierarchy simplify_in_blocks(HalfedgeMesh& mesh, const std::vector<Vec3f>& positions, std::int32_t triangles,
                             const std::vector<VertexId>& keep) {
  Hierarchy hierarchy;
  std::vector<char> kept(positions.size(), 0);
  for (const VertexId v : keep) kept[v] = 1;
  if (mesh.triangle_count() / kLeastRatio > triangles && positions.size() > 2 * kBlock) {
    const std::vector<VertexId> order = along_a_curve(positions);
    std::vector<std::int32_t> block(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) block[order[i]] = static_cast<std::int32_t>(i / kBlock);
    // A vertex and the triangles around it belong to a block where all its neighbours do; only such vertices are
    // removed, or take a removed one's triangles, so blocks neither read nor write what another one changes.
    std::vector<char> inside(positions.size(), 1);
    for_each_part(inside.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        if (mesh.outgoing[v] < 0) continue;
        for_each_neighbour(mesh, static_cast<VertexId>(v), [&](VertexId w) {
          if (block[w] != block[v]) inside[v] = 0;
        });
      }
    });
    RemovalGuard guard;
    guard.may_remove = [&](VertexId v) { return inside[v] != 0 && kept[v] == 0; };
    guard.may_grow = [&](VertexId v) { return inside[v] != 0; };
    // The side of an equilateral triangle of the proxy's mean area.
    const double side = std::sqrt(surface_area(positions, mesh.triangles) / triangles * 4 / std::sqrt(3.0));
    hierarchy.blocks.resize((positions.size() + kBlock - 1) / kBlock);
    for_each_index(hierarchy.blocks.size(), true, [&](std::size_t b) {
      std::vector<VertexId> vertices;
      for (std::size_t i = b * kBlock; i < std::min(order.size(), (b + 1) * kBlock); ++i) {
        if (inside[order[i]] && mesh.outgoing[order[i]] >= 0) vertices.push_back(order[i]);
      }
      hierarchy.blocks[b] = simplify_edges(mesh, positions, vertices, static_cast<float>(side * kShareOfLength), guard);
    });
  }
  RemovalGuard guard;
  guard.may_remove = [&](VertexId v) { return kept[v] == 0; };
  hierarchy.coarser = simplify(mesh, positions, triangles, guard);
  return hierarchy;
}

}  // namespace lozenge
