// The map while it is being built: a source mesh whose connectivity may change (levels), a domain whose connectivity
// changes (collapses and flips), and the position on the domain of every source vertex.
//
// A vertex has a home triangle and a point in its frame; a source triangle has a frame of its own, in which its image
// is flat, and for each corner the motion that takes the frame of the corner's home into it (its chart). All frames are
// those of the triangular lattice, so a chart is a rotation by sixths of a turn and a shift by whole steps, kept in
// integers. Charts say which way around the domain's cones an image lies, so nothing has to be searched while the map
// is optimized; a vertex that leaves its home takes the motion across the side along. A vertex that is pinned lies
// exactly on a domain vertex; at an irregular domain vertex (a cone) there always is one, so no source triangle has a
// cone inside. Of a pinned vertex a chart tells the position only: around a cone no rotation is right for all
// triangles. A vertex on the surface's boundary lies on the domain's (`boundary.h`).
//
// All of it is plain arrays, grouped by what a copy of a map must do with them: the surface is another one on another
// level, the state is what operations change, and the settings stay. Copies take over whole groups, so that none
// forgets an array that was added since. WorkingMap is all three at once, for most formulas need some of each.
#pragma once

#include <algorithm>
#include <vector>

#include "formats/domain/domain.h"
#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/map/energy.h"
#include "stages/parameterize/map/halfedge_mesh.h"
#include "stages/parameterize/map/plane_motion.h"
#include "stages/parameterize/map/rest_shape.h"

namespace lozenge {

/// What is mapped: a level of the source surface. Levels change it (vertices are taken out and put back); operations on
/// the domain leave it alone.
struct MappedSurface {
  const std::vector<Vec3f>* positions = nullptr;  ///< [source vertex]
  HalfedgeMesh mesh;
  std::vector<RestShape> rest;  ///< [triangle of `mesh`]
  double surface_area = 0;
  bool is_compact = false;  ///< vertices that are near on the domain have near numbers (`CompactMap`)
};

/// The abstract domain, and which source vertices are pinned to its vertices.
struct AbstractDomain {
  Domain domain;                        ///< removed triangles have corners -1
  std::int32_t domain_faces = 0;        ///< those that are left
  std::vector<DomainCorner> corner_of;  ///< [domain vertex] one of its corners; triangle -1 where it is removed
  std::vector<VertexId> anchor;         ///< [domain vertex] the source vertex pinned there, or -1
  std::vector<char> kept;               ///< [domain vertex] it stays, and so does its anchor: the user's cones
};

/// Where the surface lies on the domain.
struct SurfaceImages {
  std::vector<DomainTriangleId> home;  ///< [source vertex]
  std::vector<Vec2d> at;               ///< [source vertex] in the frame of its home
  std::vector<DomainVertex> pin;       ///< [source vertex] the domain vertex that it is pinned to, or -1
  std::vector<UnitMotion> chart;       ///< [3 * triangle + corner] from the corner's home into the triangle's frame

  /// A vertex lies where another one, of another numbering, does.
  void take_vertex(VertexId v, const SurfaceImages& other, VertexId its) {
    home[v] = other.home[its];
    at[v] = other.at[its];
    pin[v] = other.pin[its];
  }
  /// The same of a triangle, whose corners are in the same order.
  void take_triangle(TriangleId t, const SurfaceImages& other, TriangleId its) {
    for (int c = 0; c < 3; ++c) chart[3 * t + c] = other.chart[3 * its + c];
  }
};

/// The source vertices at home in each domain triangle.
struct HomeLists {
  bool listed = true;              ///< the lists are kept
  std::vector<VertexId> first_in;  ///< [domain triangle] list of the vertices at home there, or -1
  std::vector<VertexId> next_in;   ///< [source vertex]
  std::vector<VertexId> last_in;   ///< [source vertex] the one before it
};

/// All that operations on the domain change.
struct MapState : AbstractDomain, SurfaceImages, HomeLists {};

/// What a map is asked to be; no operation changes it.
struct MapSettings {
  double flattest = kFlattest;  ///< rest shapes are at least so high for their length (`rest_shape`)
  Energy energy;
  double star_conformality = 0;  ///< of the star domains that irregular vertices crawl in (StarShape)
  /// Domains of up to so many triangles are judged by the whole map at every step: thorough, and slow.
  std::int32_t small_domain = 36;
};

struct WorkingMap : MappedSurface, MapState, MapSettings {
  MappedSurface& surface() { return *this; }
  const MappedSurface& surface() const { return *this; }
  AbstractDomain& abstract_domain() { return *this; }
  const AbstractDomain& abstract_domain() const { return *this; }
  SurfaceImages& images() { return *this; }
  const SurfaceImages& images() const { return *this; }
  MapState& state() { return *this; }
  const MapState& state() const { return *this; }
  MapSettings& settings() { return *this; }
  const MapSettings& settings() const { return *this; }

  /// What T and d are multiplied with, so that the whole surface has the domain's area.
  double scale() const { return scale_with(domain_faces); }
  /// The same were there so many domain triangles.
  double scale_with(std::int32_t faces) const { return surface_area / (faces * 0.5 * kHalfRoot3); }
};

/// The trivial map (paper, Sec. 5.1, start-up): one domain triangle for each source triangle, every vertex pinned.
WorkingMap trivial_map(const std::vector<Vec3f>& positions, HalfedgeMesh mesh, const MapSettings& settings = {});

/// The map of a finished parameterization, to go on with.
WorkingMap working_map(const SourceMesh& mesh, const Parameterization& map);

/// Rest shapes of all triangles of `map.mesh`, and their total area.
void measure_rest_shapes(WorkingMap& map);

/// Gives the vertices their arrays, without a home.
void put_vertices_nowhere(WorkingMap& map);

/// One number for an edge of the domain: the lower of a side and its neighbour, 3 triangle + side.
inline std::int32_t edge_number(const Domain& domain, DomainSide side) {
  const DomainSide across = domain.neighbour(side);
  const std::int32_t here = 3 * side.triangle + side.side;
  return across.exists() ? std::min(here, 3 * across.triangle + across.side) : here;
}

/// Every edge of the domain that is left once, by its side of the lower number, in their order.
template <typename Function>
void for_each_edge(const Domain& domain, Function&& function) {
  for (DomainTriangleId t = 0; t < domain.size(); ++t) {
    for (int s = 0; s < 3 && domain.corner(t, 0) >= 0; ++s) {
      if (edge_number(domain, {t, s}) == 3 * t + s) function(DomainSide{t, s});
    }
  }
}

}  // namespace lozenge
