// Parameterized surfaces with a boundary whose map is known exactly: for tests of whatever must end where they do.
#pragma once

#include <string>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/surface_view.h"

namespace lozenge::fixtures {

struct OpenSurface {
  std::string name;
  SourceMesh mesh;
  Parameterization map;
  int loops = 1;  ///< where it ends
  int euler = 1;
};

/// One domain triangle, n^2 source triangles, a little curved.
OpenSurface triangle(int n);

/// Half of the octahedron's sphere: a disk whose boundary vertices have two triangles, n^2 source triangles in each.
OpenSurface hemisphere(int n);

/// The icosahedron's sphere without the five faces around a vertex: its boundary vertices have three triangles.
OpenSurface bowl(int n);

/// `triangles` of them around a vertex of the boundary, which therefore has that many; the two at the ends of the fan
/// have one each. From four on the map is bent around that vertex.
OpenSurface fan(int triangles, int n);

/// A band of 2 `sectors` domain triangles around a cylinder, every boundary vertex with three triangles, so that none
/// needs a source vertex: the source's grid of `columns` x `rows` cells is turned by `shift` (of a domain side), and
/// its sides run across the domain's as they like. Two boundary loops. \pre  sectors >= 3, and no cell is wider than a
/// domain side
OpenSurface annulus(int sectors, int columns, int rows, double shift);

/// A hemisphere, and a whole octahedron's sphere beside it.
OpenSurface open_and_closed(int n);

/// The same, with the sphere's domain triangles a quarter as long as the hemisphere's: its first level is 2.
OpenSurface two_scales(int n);

/// All of them, small and smaller, maps moved about inside of domain triangles where that keeps them sound.
std::vector<OpenSurface> open_surfaces();

/// The largest distance from any vertex of the boundary of one surface to the boundary of the other, in their units.
double boundary_distance(const SurfaceView& from, const SurfaceView& to);

}  // namespace lozenge::fixtures
