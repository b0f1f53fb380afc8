// The inverse of phi (paper, Sec. 3): which point of the source surface is mapped to a place on the domain, found
// exactly.
//
// A source triangle's image is flat and known in lattice integers (formats/development.h), but may lie across several
// domain triangles. SourceLocator lists, for each domain triangle, the images that overlap it; TriangleLocator bins
// those of one domain triangle in a grid and answers for places in it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// A point of the source surface.
struct SourcePoint {
  TriangleId triangle = -1;
  Vec3d weights{0, 0, 0};  ///< barycentric, one for each corner of the triangle; none is negative
};

/// A point of the source surface, and how its weights change along the lattice of the domain around its image.
struct LocatedPoint {
  SourcePoint point;
  Vec3d along_u{0, 0, 0};  ///< change of the weights for a side of a domain triangle along the lattice's u
  Vec3d along_v{0, 0, 0};
};

/// Position of a surface point, rounded once; never -0.
Vec3f position_at(const SourceMesh& mesh, const SourcePoint& p);

/// The images over each domain triangle.
class SourceLocator {
 public:
  /// Keeps references to both. Runs in parallel.
  /// \throws Error(kUnusableInput) naming the first source triangle whose image is folded, or that has none
  SourceLocator(const SourceMesh& mesh, const Parameterization& map);

  /// One image, as seen from a domain triangle that it overlaps.
  struct Image {
    TriangleId source = -1;
    std::int32_t moved = -1;  ///< index into the moved corners, or -1 where all three vertices' own positions lie there
  };

  /// Images whose area in common with the domain triangle is not zero, by ascending source triangle. Around a vertex
  /// of few triangles the same one can be there twice, in different places.
  std::span<const Image> over(DomainTriangleId triangle) const {
    return {images_.data() + first_[triangle], images_.data() + first_[triangle + 1]};
  }

  /// Corners of the image in that domain triangle's frame, counter-clockwise.
  std::array<LatticePoint, 3> corners(const Image& image) const;

 private:
  const SourceMesh& mesh_;
  const Parameterization& map_;
  std::vector<std::size_t> first_;  ///< [domain triangle] into images_; one more at the end
  std::vector<Image> images_;
  std::vector<std::array<LatticePoint, 3>> moved_;
};

/// Answers for one domain triangle.
class TriangleLocator {
 public:
  /// Keeps a reference to `all`.
  TriangleLocator(const SourceLocator& all, DomainTriangleId triangle);

  /// The surface point whose image is the place; where several source triangles hold it (on their edges), the first.
  /// Nothing where no image covers the place, which a sound map does not have. \pre in_triangle(place)
  std::optional<SourcePoint> find(LatticePoint place) const;
  /// The same, and the map's derivatives there.
  std::optional<LocatedPoint> locate(LatticePoint place) const;

 private:
  std::int32_t bin(std::int64_t coordinate) const;
  /// Calls `found(point, corners of the image)` for the image that holds the place.
  template <typename Found>
  void find_image(LatticePoint place, const Found& found) const;
  template <typename Visit>
  void for_each_bin(const std::array<LatticePoint, 3>& corners, Visit visit) const;

  const SourceLocator& all_;
  std::span<const SourceLocator::Image> images_;
  int shift_ = 40;                    ///< a bin is 2^shift_ lattice steps wide and high
  std::int32_t bins_ = 1;             ///< a side
  std::vector<std::int32_t> first_;   ///< [bin, row by row] into listed_; one more at the end
  std::vector<std::int32_t> listed_;  ///< indices of images_, ascending in each bin
};

/// Answers for the whole domain.
class DomainLocator {
 public:
  /// Keeps references to both. Runs in parallel.
  /// \throws Error(kUnusableInput) as SourceLocator does
  DomainLocator(const SourceMesh& mesh, const Parameterization& map);
  DomainLocator(const DomainLocator&) = delete;
  DomainLocator& operator=(const DomainLocator&) = delete;

  /// As TriangleLocator::find, in the triangle that the position names.
  std::optional<SourcePoint> find(const DomainPoint& place) const {
    return triangles_[place.triangle]->find(lattice_point(place));
  }

 private:
  SourceLocator all_;
  std::vector<std::optional<TriangleLocator>> triangles_;  ///< [domain triangle]
};

}  // namespace lozenge
