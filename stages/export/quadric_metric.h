// What it costs to make one vertex of two: Garland and Heckbert's quadric error metric (Surface Simplification Using
// Quadric Error Metrics, SIGGRAPH 1997), in which outlines and lines that have a shape count as planes, too; and
// besides it what one sees of the atlas, and the poses of skins.
#pragma once

#include <vector>

#include "stages/export/collapsible_mesh.h"
#include "stages/export/outline.h"
#include "stages/export/quadric.h"

namespace lozenge {

/// What would be left of two vertices.
struct MergedVertex {
  Vec3d position{0, 0, 0};
  Vec3d anchor{0, 0, 0};  ///< about the source's point at its place in the atlas
  double share = 1;       ///< of the way from one to the other where the texture coordinates go
  double posed = 0;       ///< of its cost, what poses add
  double cost = 0;        ///< squared distances by areas
};

class QuadricMetric {
 public:
  /// Keeps a reference. \param mesh  of which nothing has gone yet \param importance  [triangle] weighs its distances;
  /// empty: all the same
  QuadricMetric(const CollapsibleMesh& mesh, const std::vector<float>& importance,
                const std::vector<OutlineEdge>& outline);

  /// Where what is left of the two lies, in space and in the atlas, and what that costs.
  /// \param may_slide  in the atlas: anywhere from one to the other, not only to where the second is
  /// \param stays_put  the second one does, in space
  MergedVertex merged(VertexId from, VertexId to, bool may_slide, bool stays_put) const;

  /// What it costs that patches show another part of their squares around a corner that goes.
  double slip(VertexId from, VertexId to) const;

  void join(VertexId from, VertexId to, const MergedVertex& merged);

 private:
  void add_planes(const std::vector<float>& importance);
  void add_outline(const std::vector<OutlineEdge>& outline);
  void add_walls();
  double seen(VertexId v) const;
  double error_in_poses(VertexId from, VertexId to, double share) const;

  const CollapsibleMesh& mesh_;
  std::vector<Quadric> quadrics_;    ///< [vertex]
  std::vector<Vec3d> anchors_;       ///< [vertex] see `MergedVertex`
  std::vector<double> areas_;        ///< [vertex] of the source, that it stands for, weighed by importance
  std::vector<double> plain_areas_;  ///< the same, not weighed
  double joint_reach_;
};

}  // namespace lozenge
