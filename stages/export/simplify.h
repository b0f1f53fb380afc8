// Coarser levels of detail: the triangles of a charted surface become fewer by collapsing edges, the least missed first
// (Garland and Heckbert 1997), while each patch keeps its place in the atlas.
//
// Vertices inside of a patch go anywhere; those on a border of two patches, on the surface's end or on the border of
// two groups along that line alone, and where such lines meet they stay. So texture coordinates stay within their
// tiles, and borders are what they were: one vertex for all patches that share it. No triangle is turned over in space
// or in the atlas.
//
// That ends at two triangles of each patch. Only then may corners of patches go, too: a border shrinks to a point, for
// which each patch has the place of its own, and so shows a part of its square, or nothing. A piece of which nothing
// could go until then, such as a box of twelve triangles, stays whole.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "formats/patches/charted_surface.h"
#include "formats/patches/leave_out_flat_vertices.h"

namespace lozenge {

/// What becomes of lines: borders of patches and groups, and the surface's end.
enum class Lines : std::uint8_t {
  kSimplify,
  kStay,  ///< each vertex of theirs stays where it is
};

class Simplifier {
 public:
  /// \param charts        [patch]
  /// \param least_height  of a triangle in the atlas, in texels: what rounding doesn't turn
  Simplifier(ChartedSurface surface, const std::vector<ChartScale>& charts, double least_height,
             Lines lines = Lines::kSimplify);
  ~Simplifier();
  Simplifier(const Simplifier&) = delete;
  Simplifier& operator=(const Simplifier&) = delete;

  /// Collapses edges until no more than so many triangles are left, or none can be collapsed any more.
  void reduce_to(std::int64_t triangles);

  /// Collapses what sides it can of triangles that face against all of their neighbours, as in a torn source.
  void mend_turned();

  std::int64_t triangle_count() const;
  /// Whether corners of patches have gone, so that patches no longer show all of their squares.
  bool has_moved_corners() const;
  /// What is left; what corners carry and the planes of triangles are no longer right.
  /// \param origins  unless null: gets the number that each vertex had in the given surface
  ChartedSurface surface(std::vector<VertexId>* origins = nullptr) const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace lozenge
