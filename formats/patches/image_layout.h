// The image of a source triangle, and the patches that it lies on, laid out flat (paper, Sec. 4.1 and 4.2).
#pragma once

#include <optional>
#include <vector>

#include "formats/base/vector.h"
#include "formats/patches/patch_layout.h"
#include "formats/patches/unfolding.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// What is nearer than this (in sides of a domain triangle) is in one place: a thousand steps of the lattice.
inline constexpr double kTogether = 1e-9;

/// A point of a frame in sides of a domain triangle, along the frame's two axes.
Vec2d in_sides(LatticePoint p);

/// A patch, laid out under an image.
struct PatchBelow {
  std::int32_t patch = -1;
  LatticeMotion from_home;  ///< from the frame of the image's home into the patch's
  bool is_half = false;     ///< only v >= u of its square exists

  friend bool operator==(const PatchBelow& a, const PatchBelow& b) {
    return a.patch == b.patch && a.from_home.sixths == b.from_home.sixths && a.from_home.shift == b.from_home.shift;
  }
};

/// The patch of a domain triangle's side. \param halves  of `places`
PatchBelow patch_below(const std::vector<PatchPlace>& places, const std::vector<PatchHalf>& halves,
                       const UnfoldedTriangle& triangle, int side);

/// Where a point of the home's frame lies in the patch's square.
Vec2d place_in(const PatchBelow& patch, const Vec2d& p);
/// The same of a point of the lattice: exact but for one rounding, so that all triangles around a vertex agree.
Vec2d place_in(const PatchBelow& patch, LatticePoint p);

/// Whether the patch has a place, or something as near to it as `slack`.
bool holds(const PatchBelow& patch, const Vec2d& place, double slack);

/// An image, and what it lies on.
struct ImageLayout {
  TriangleId source = -1;
  Development image;
  std::vector<UnfoldedTriangle> triangles;
  std::vector<PatchBelow> patches;
  double together = kTogether;  ///< what is nearer is in one place
};

ImageLayout layout_of_image(const Domain& domain, const std::vector<PatchPlace>& places,
                            const std::vector<PatchHalf>& halves, TriangleId source, const Development& image);

/// A border between patches: from the barycentre of a domain triangle to one of its corners, three times as large:
/// barycentres are points of that lattice.
struct Spoke {
  LatticePoint barycentre;
  LatticePoint corner;
};

/// The borders of all patches that an image lies on, in the frame of its home.
std::vector<Spoke> spokes_below(const ImageLayout& layout);

/// The share of the way from p to q where a spoke is crossed, or nothing.
std::optional<double> crossing(const Spoke& spoke, LatticePoint p, LatticePoint q);

}  // namespace lozenge
