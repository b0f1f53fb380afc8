// Places on borders and corners are told by integers; only how far along an edge a border is crossed is rounded.
#include "formats/patches/image_layout.h"

#include <algorithm>
#include <array>

namespace lozenge {

namespace {

Vec2d rotated_by(Vec2d p, int sixths) {
  for (int i = 0; i < sixths; ++i) p = {-p.y, p.x + p.y};
  return p;
}

Vec2d moved(const LatticeMotion& motion, const Vec2d& p) {
  return rotated_by(p, motion.sixths) + in_sides(motion.shift);
}

/// Three times a point of a domain triangle's frame, in the home's: barycentres are points of that lattice.
LatticePoint thrice(const LatticeMotion& into_home, LatticePoint three_times) {
  const LatticePoint shift = into_home.shift;
  return rotated(three_times, into_home.sixths) + LatticePoint{3 * shift.u, 3 * shift.v};
}

LatticePoint times_three(LatticePoint p) { return {3 * p.u, 3 * p.v}; }

}  // namespace

Vec2d in_sides(LatticePoint p) {
  constexpr double kStep = 1.0 / static_cast<double>(kLatticeOne);
  return {static_cast<double>(p.u) * kStep, static_cast<double>(p.v) * kStep};
}

PatchBelow patch_below(const std::vector<PatchPlace>& places, const std::vector<PatchHalf>& halves,
                       const UnfoldedTriangle& triangle, int side) {
  const PatchHalf half = halves[3 * static_cast<std::size_t>(triangle.triangle) + side];
  return {half.patch, composed(into_patch(side, half.left), inverse(triangle.into_home)),
          !places[half.patch].right.exists()};
}

Vec2d place_in(const PatchBelow& patch, const Vec2d& p) {
  const Vec2d q = moved(patch.from_home, p);
  return {q.x - q.y, q.x + 2 * q.y};
}

Vec2d place_in(const PatchBelow& patch, LatticePoint p) { return in_sides(in_square(patch.from_home(p))); }

bool holds(const PatchBelow& patch, const Vec2d& place, double slack) {
  return place.x >= -slack && place.y >= -slack && place.x <= 1 + slack && place.y <= 1 + slack &&
         (!patch.is_half || place.y >= place.x - slack);
}

ImageLayout layout_of_image(const Domain& domain, const std::vector<PatchPlace>& places,
                            const std::vector<PatchHalf>& halves, TriangleId source, const Development& image) {
  ImageLayout layout{source, image, unfold(domain, image), {}};
  for (const UnfoldedTriangle& triangle : layout.triangles) {
    for (int side = 0; side < 3; ++side) {
      const PatchBelow patch = patch_below(places, halves, triangle, side);
      if (std::find(layout.patches.begin(), layout.patches.end(), patch) == layout.patches.end()) {
        layout.patches.push_back(patch);
      }
    }
  }
  return layout;
}

std::vector<Spoke> spokes_below(const ImageLayout& layout) {
  std::vector<Spoke> spokes;
  static constexpr std::array<LatticePoint, 3> kCorners{LatticePoint{0, 0}, LatticePoint{3 * kLatticeOne, 0},
                                                        LatticePoint{0, 3 * kLatticeOne}};
  for (const UnfoldedTriangle& t : layout.triangles) {
    const LatticePoint barycentre = thrice(t.into_home, {kLatticeOne, kLatticeOne});
    for (const LatticePoint corner : kCorners) spokes.push_back({barycentre, thrice(t.into_home, corner)});
  }
  return spokes;
}

std::optional<double> crossing(const Spoke& spoke, LatticePoint p, LatticePoint q) {
  const LatticeArea at_p = doubled_area(spoke.barycentre, spoke.corner, times_three(p));
  const LatticeArea at_q = doubled_area(spoke.barycentre, spoke.corner, times_three(q));
  if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) return std::nullopt;
  const double share = static_cast<double>(at_p) / static_cast<double>(at_p - at_q);
  const Vec2d start = in_sides(times_three(p));
  const Vec2d at = start + (in_sides(times_three(q)) - start) * share - in_sides(spoke.barycentre);
  const Vec2d along = in_sides(spoke.corner - spoke.barycentre);
  const double reach = at.dot(along) / along.length2();
  if (!(reach >= -kTogether && reach <= 1 + kTogether)) return std::nullopt;
  return share;
}

}  // namespace lozenge
