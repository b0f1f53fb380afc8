// Shapes for the test assets: plain triangle meshes from formulas, the same bits at every run.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge::test_assets {

/// Triangles over shared vertices, counter-clockwise seen from outside.
struct Shape {
  std::vector<Vec3f> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The unit sphere: an icosahedron or octahedron whose triangles are split in four `times` times.
Shape icosphere(int times);
Shape octasphere(int times);

/// A grid of nu x nv quads that closes in both directions, over u, v in [0, 1).
Shape closed_grid(int nu, int nv, const std::function<Vec3d(double, double)>& place);

/// The sphere with smooth waves on it.
Shape bumpy_sphere();

/// A ring around the z axis.
Shape torus(double ring_radius, double tube_radius, int nu, int nv);

/// A tube along a trefoil.
Shape knot();

/// A part from a lathe, as a CAD program would tessellate it: caps that are fans around one vertex of high valence,
/// walls of slivers a hundred times as long as wide, rings that shrink geometrically, and a few triangles split again
/// and again.
Shape uneven();

/// Three rings in a row, melted together: genus 3.
Shape genus3();

/// An idol with its arms akimbo and a ring on its head, genus 3, with flutes, lozenges and curls in fine relief.
Shape statue();

/// The zero set of `field` (negative inside) inside the box, from a grid of cubes of side `cell`, each cut into six
/// tetrahedra: always a closed manifold where the field is positive on the walls of the box. The vertices are then
/// spread evenly over the surface in `rounds` of smoothing.
Shape implicit_surface(const std::function<double(const Vec3d&)>& field, const Vec3d& low, const Vec3d& high,
                       double cell, int rounds);

/// A flat disk in rings, ring r of 6 r vertices: 6 rings^2 triangles and one boundary.
Shape disk(int rings);

/// A flat ring of nu x nv quads, between the circles of radius 1 and 0.5.
Shape annulus(int nu, int nv);

/// The half z >= 0 of `octasphere`.
Shape hemisphere(int times);

/// A flat rectangle of nu x nv square quads, one unit high.
Shape plane(int nu, int nv);

Shape single_triangle();

/// Unit normals at the vertices, the triangles around weighted by area.
std::vector<Vec3f> smooth_normals(const Shape& shape);

/// Six times the enclosed volume; positive where the triangles face outwards.
double signed_volume(const Shape& shape);

}  // namespace lozenge::test_assets
