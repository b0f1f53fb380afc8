// Coarser levels of detail: the triangles of a charted surface become fewer by collapsing edges, the least missed first
// (Garland and Heckbert 1997), while each patch keeps its place in the atlas.
//
// Vertices inside of a patch go anywhere, and those on a border of two patches, on the surface's end or on the border
// of two groups along that line: so texture coordinates stay within their tiles, patches show all of their squares, and
// borders are what they were, one vertex for all patches that share it. Any other edge may go, too, at a price: then a
// patch loses a part of its square, or all of it, and what it shows slips on the surface by the length of the edge; the
// ends of lines that have a shape (the surface's end, borders of groups) never leave them. No triangle is turned over
// in space or in the atlas.
//
// A piece of which nothing can go but corners of patches, such as a box of twelve triangles, costs much more to change,
// and where a surface has no other pieces they stay whole.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/leave_out_flat_vertices.h"
#include "stages/export/chart_lines.h"
#include "stages/export/outline.h"

namespace lozenge {

struct SimplifierOptions {
  Lines lines = Lines::kSimplify;
  std::vector<float> importance = {};     ///< [triangle] weighs its distances; empty: all the same
  std::vector<OutlineEdge> outline = {};  ///< distances that count besides those of the planes of triangles
};

class Simplifier {
 public:
  /// \param charts        [patch]
  /// \param least_height  of a triangle in the atlas, in texels: what rounding doesn't turn
  Simplifier(ChartedSurface surface, const std::vector<ChartScale>& charts, double least_height,
             const SimplifierOptions& options = {});
  ~Simplifier();
  Simplifier(const Simplifier&) = delete;
  Simplifier& operator=(const Simplifier&) = delete;

  /// Collapses edges until no more than so many triangles are left, or none can be collapsed any more.
  void reduce_to(std::int64_t triangles);

  /// Collapses what sides it can of triangles that face against all of their neighbours, as in a torn source.
  void mend_turned();

  std::int64_t triangle_count() const;
  /// [patch] whether it no longer shows each place of its square where that is on the surface.
  const std::vector<bool>& slipped_patches() const;
  /// What is left; what corners carry and the planes of triangles are no longer right.
  /// \param origins  unless null: gets the number that each vertex had in the given surface
  ChartedSurface surface(std::vector<VertexId>* origins = nullptr) const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace lozenge
