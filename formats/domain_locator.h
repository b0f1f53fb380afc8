// The inverse of the map phi (paper, Sec. 3): from a position on the domain to the point of the surface whose image it
// is.
//
// The flat image of every source triangle (see `develop`) is noted in each domain triangle that it overlaps, and found
// again through a grid over that triangle. Tests are exact on the lattice, and the images of a sound map tile the
// domain, so every position is found.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "formats/domain_point.h"
#include "formats/parameterization.h"
#include "formats/patch_set.h"
#include "formats/source_mesh.h"
#include "formats/vector.h"

namespace lozenge {

/// A point of a triangle mesh.
struct SurfacePoint {
  TriangleId triangle = -1;
  Vec3d weights{1, 0, 0};  ///< barycentric, none below 0

  bool exists() const { return triangle >= 0; }
};

/// The position of a surface point, in the mesh's units.
Vec3d position_at(const SourceMesh& mesh, const SurfacePoint& p);

/// Where the place (u, v) of a patch lies on the domain (see `PatchPlace`), to the nearest lattice point.
/// \pre  0 <= u, v <= 1, and v >= u where the patch has no right triangle
DomainPoint domain_point_at(const PatchPlace& place, double u, double v);

class DomainLocator {
 public:
  /// Keeps no reference to either.
  /// \throws Error(kUnusableInput) where a source triangle has no image, or one that is folded
  DomainLocator(const SourceMesh& mesh, const Parameterization& map);

  /// The surface point whose image is `p`: of several source triangles that hold it (on their edges), the lowest of
  /// those whose images overlap the inside of `p.triangle`. Triangle -1 where none holds it: the map is not sound. \pre
  /// p.triangle is a triangle of the domain
  SurfacePoint locate(const DomainPoint& p) const;

 private:
  /// The image of a source triangle, in the frame of a domain triangle that it overlaps.
  struct Image {
    TriangleId source = -1;
    std::array<LatticePoint, 3> corners{};
  };
  /// Where the lists of one domain triangle's cells are.
  struct Grid {
    std::int64_t cells = 1;      ///< a side of the grid over the frame's unit square
    std::size_t first_list = 0;  ///< in `list_starts_`; cells row by row, and one more for the end
  };
  struct NotedImage {
    DomainTriangleId where = -1;
    Image image;
  };

  static void note_images(const SourceMesh& mesh, const Parameterization& map, TriangleId t,
                          std::vector<NotedImage>& noted);
  void sort_by_domain_triangle(const std::vector<std::vector<NotedImage>>& noted, std::int32_t domain_size);
  void fill_grid(DomainTriangleId where);

  std::vector<Image> images_;               ///< by domain triangle, then by source triangle
  std::vector<std::size_t> first_image_;    ///< [domain triangle] in `images_`; one more for the end
  std::vector<Grid> grids_;                 ///< [domain triangle]
  std::vector<std::uint32_t> list_starts_;  ///< in `entries_`
  std::vector<std::uint32_t> entries_;      ///< indices into `images_`, ascending in every list
};

}  // namespace lozenge
