// Where the borders of patches cross the edges of a source mesh.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "formats/patches/image_layout.h"
#include "formats/patches/source_cut.h"

namespace lozenge {

/// The cuts of an edge: consecutive cut points, by rising share.
struct CutsOfEdge {
  std::int32_t first = 0;
  std::int32_t count = 0;
};

/// Every edge is cut once, for both of its triangles.
class EdgeCuts {
 public:
  explicit EdgeCuts(const SourceMesh& mesh) : mesh_(mesh) {}

  /// Cuts the edges of a triangle, those that no other has cut before.
  void add(const ImageLayout& layout);

  /// \pre a triangle at that edge was added
  const CutsOfEdge& at(VertexId a, VertexId b) const { return cuts_.at(edge_of(a, b)); }
  const std::vector<CutPoint>& points() const { return points_; }

 private:
  using Edge = std::array<VertexId, 2>;
  struct EdgeHash {
    std::size_t operator()(const Edge& e) const {
      return std::hash<std::uint64_t>()(static_cast<std::uint64_t>(e[0]) << 32 | static_cast<std::uint32_t>(e[1]));
    }
  };

  static Edge edge_of(VertexId a, VertexId b) { return {a < b ? a : b, a < b ? b : a}; }
  CutsOfEdge add_cuts(const Edge& edge, const std::vector<double>& shares, double together);

  const SourceMesh& mesh_;
  std::vector<CutPoint> points_;
  std::unordered_map<Edge, CutsOfEdge, EdgeHash> cuts_;
};

}  // namespace lozenge
