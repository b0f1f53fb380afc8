// The lines of a charted surface that collapses of edges keep to: borders of patches and groups, and the surface's end.
#pragma once

#include <cstdint>
#include <vector>

#include "stages/export/collapsible_mesh.h"

namespace lozenge {

/// What becomes of lines: borders of patches and groups, and the surface's end.
enum class Lines : std::uint8_t {
  kSimplify,
  kStay,  ///< each vertex of theirs stays where it is
};

enum class VertexKind : std::uint8_t {
  kFree,    ///< inside of a patch
  kOnLine,  ///< on a border, or the surface's end: two edges at it are of that line
  kCorner,  ///< where borders of patches meet or turn, and lines that have a shape go on
  kFixed,   ///< where lines that have a shape meet or end
};

class ChartLines {
 public:
  /// Keeps a reference. \param mesh  of which nothing has gone yet
  ChartLines(const CollapsibleMesh& mesh, Lines lines);

  bool is_same_kind(VertexId a, VertexId b) const { return kinds_[a] == kinds_[b]; }
  /// Whether a vertex stays where it is in space, too.
  bool stays_put(VertexId v) const { return lines_ == Lines::kStay && kinds_[v] == VertexKind::kFixed; }

  /// Whether an edge runs along a line that one of its ends moves along, or has an end that is on none: then each patch
  /// keeps showing all of its square.
  bool keeps_squares(VertexId a, VertexId b, const EdgeTriangles& at) const;
  /// Whether the kinds of the ends of an edge let it go. \param corners  of patches may
  bool may_go(VertexId a, VertexId b, const EdgeTriangles& at, bool corners) const;
  /// Whether the first of the two stays: what is on a line that has a shape, and what is less free.
  bool stays(VertexId a, VertexId b) const;

  /// What is left of both.
  void join(VertexId from, VertexId to, bool keeps_squares);

 private:
  const CollapsibleMesh& mesh_;
  Lines lines_;
  std::vector<VertexKind> kinds_;
  std::vector<std::uint8_t> has_feature_;  ///< [vertex] it is on a line that has a shape
};

}  // namespace lozenge
