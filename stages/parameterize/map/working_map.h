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
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "formats/domain/domain.h"
#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/map/energy.h"
#include "stages/parameterize/map/halfedge_mesh.h"
#include "stages/parameterize/map/plane_motion.h"
#include "stages/parameterize/map/rest_shape.h"

namespace lozenge {

/// Most domain triangles around one vertex. Around a cone of 12 and more, two fans of source triangles could each turn
/// all the way, and then there is no place from which a vertex that is put back there sees its neighbours.
inline constexpr int kMostValence = 10;
/// On the boundary, where a fan that turns by half of a turn or more hides the straight boundary beside it.
inline constexpr int kMostValenceOnBoundary = 5;

/// A set of small numbers that is emptied in no time.
class Marks {
 public:
  void clear(std::size_t size) {
    if (marked_.size() < size) marked_.resize(size, 0);
    ++now_;
  }
  bool has(std::int32_t i) const { return marked_[i] == now_; }
  /// \return whether it was not there before
  bool add(std::int32_t i) {
    if (marked_[i] == now_) return false;
    marked_[i] = now_;
    return true;
  }

 private:
  std::vector<std::int32_t> marked_;
  std::int32_t now_ = 0;
};

/// Numbers given to some of many, all forgotten in no time.
class Numbering {
 public:
  void clear(std::size_t size) {
    marks_.clear(size);
    if (numbers_.size() < size) numbers_.resize(size);
  }
  void set(std::int32_t i, std::int32_t number) {
    marks_.add(i);
    numbers_[i] = number;
  }
  /// -1 where it has none
  std::int32_t find(std::int32_t i) const { return marks_.has(i) ? numbers_[i] : -1; }

 private:
  Marks marks_;
  std::vector<std::int32_t> numbers_;
};

struct WorkingMap {
  const std::vector<Vec3f>* positions = nullptr;  ///< [source vertex]
  HalfedgeMesh mesh;
  std::vector<RestShape> rest;  ///< [triangle of `mesh`]
  double surface_area = 0;
  double flattest = kFlattest;  ///< rest shapes are at least so high for their length (`rest_shape`)

  Domain domain;                        ///< removed triangles have corners -1
  std::int32_t domain_faces = 0;        ///< those that are left
  std::vector<DomainCorner> corner_of;  ///< [domain vertex] one of its corners; triangle -1 where it is removed
  std::vector<VertexId> anchor;         ///< [domain vertex] the source vertex pinned there, or -1
  std::vector<char> kept;               ///< [domain vertex] it stays, and so does its anchor: the user's cones

  std::vector<DomainTriangleId> home;  ///< [source vertex]
  std::vector<Vec2d> at;               ///< [source vertex] in the frame of its home
  std::vector<DomainVertex> pin;       ///< [source vertex] the domain vertex that it is pinned to, or -1
  std::vector<UnitMotion> chart;       ///< [3 * triangle + corner] from the corner's home into the triangle's frame

  bool listed = true;              ///< the lists of the vertices at home are kept
  std::vector<VertexId> first_in;  ///< [domain triangle] list of the vertices at home there, or -1
  std::vector<VertexId> next_in;   ///< [source vertex]
  std::vector<VertexId> last_in;   ///< [source vertex] the one before it

  bool is_compact = false;  ///< vertices that are near on the domain have near numbers (`CompactMap`)

  Energy energy;
  double star_conformality = 0;  ///< of the star domains that irregular vertices crawl in (StarShape)
  /// Domains of up to so many triangles are judged by the whole map at every step: thorough, and slow.
  std::int32_t small_domain = 36;

  /// What T and d are multiplied with, so that the whole surface has the domain's area.
  double scale() const { return surface_area / (domain_faces * 0.5 * kHalfRoot3); }
};

/// The trivial map (paper, Sec. 5.1, start-up): one domain triangle for each source triangle, every vertex pinned.
WorkingMap trivial_map(const std::vector<Vec3f>& positions, HalfedgeMesh mesh, double flattest = kFlattest);

/// The map of a finished parameterization, to go on with.
WorkingMap working_map(const SourceMesh& mesh, const Parameterization& map);

/// Rest shapes of all triangles of `map.mesh`, and their total area.
void measure_rest_shapes(WorkingMap& map);

/// Gives the vertices their arrays, without a home.
void put_vertices_nowhere(WorkingMap& map);

/// Makes the lists anew, for a map whose vertices moved while `listed` was off.
void list_homes(WorkingMap& map);

/// Every vertex, those of a domain triangle together.
std::vector<VertexId> vertices_by_triangle(const WorkingMap& map);

/// Puts a vertex into a home's list and at a point of it; its charts are the caller's.
void set_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at);
/// Moves a vertex to another home, whose frame `back` takes into that of the old one, and its charts along.
void move_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at, const UnitMotion& back);
/// Pins a vertex to a domain vertex (which must have no anchor); its charts are the caller's.
void pin_to(WorkingMap& map, VertexId v, DomainVertex corner);
void unpin(WorkingMap& map, VertexId v);
/// Gives a pinned vertex the corner that `corner_of` names now, its image unchanged.
void renew_pin(WorkingMap& map, VertexId v);
/// Lets go of a vertex that is pinned to a regular domain vertex, and finds its charts.
/// \return false, with nothing changed, where too much around it is pinned for that
bool free_regular_vertex(WorkingMap& map, VertexId v);

/// The corner of its home that a pinned vertex lies in.
int corner_of_pinned(const WorkingMap& map, VertexId v);

/// The chart of a vertex pinned to a domain triangle's corner, whose image lies at `step` of a triangle's frame.
inline UnitMotion chart_of_pinned(int corner, UnitPoint step) { return {0, step - corner_step(corner)}; }

/// The domain's corners around a vertex, counter-clockwise; on the boundary from one end of the fan to the other.
std::vector<DomainCorner> star_of(const WorkingMap& map, DomainVertex v);

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

/// Number of domain triangles around the vertex, and whether it lies on the boundary.
struct Valence {
  int triangles = 0;
  bool on_boundary = false;

  /// How many triangles it lacks (or, negative, has too many) to be flat, on the boundary straight.
  int lack() const { return (on_boundary ? 3 : 6) - triangles; }
  bool is_regular() const { return lack() == 0; }
  int most() const { return on_boundary ? kMostValenceOnBoundary : kMostValence; }
  int least() const { return on_boundary ? 1 : 3; }
};
Valence valence(const WorkingMap& map, DomainVertex v);

/// The image of a triangle's corner, in the triangle's frame.
inline Vec2d image_of_corner(const WorkingMap& map, TriangleId t, int corner) {
  return map.chart[3 * t + corner](map.at[map.mesh.triangles[t][corner]]);
}

/// A source triangle's corners, flat, in the triangle's frame.
using FlatImage = std::array<Vec2d, 3>;
FlatImage flat_image(const WorkingMap& map, TriangleId t);

inline double doubled_area(const FlatImage& p) { return cross(p[1] - p[0], p[2] - p[0]); }
/// Twice the area of the image.
inline double doubled_image_area(const WorkingMap& map, TriangleId t) { return doubled_area(flat_image(map, t)); }

/// From the frame of the triangle of half-edge h into the frame of its twin's triangle.
UnitMotion motion_across(const WorkingMap& map, Halfedge h);

/// The neighbours of a vertex, counter-clockwise, in the frame of its home. Triangle i lies between neighbours i and
/// i + 1; of a vertex on the boundary there is one neighbour more than triangles.
struct Ring {
  std::vector<Vec2d> at;
  std::vector<Halfedge> halfedges;  ///< from the centre to neighbour i, in triangle i
};

/// \pre the vertex is not pinned
void gather_ring(const WorkingMap& map, VertexId v, Ring& ring);

/// The triangles around the vertices, each once.
void triangles_around(const WorkingMap& map, const std::vector<VertexId>& vertices, Marks& marks,
                      std::vector<TriangleId>& triangles);

/// The charts of a triangle and of the triangles beside it tell the same of the edges that they share.
bool is_consistent(const WorkingMap& map, TriangleId t);

/// A triangle's charts are those of the straight lines between its corners, as the domain is.
bool agrees_with_domain(const WorkingMap& map, TriangleId t);

/// All triangles around the vertex have images of positive area that agree with their neighbours'.
bool is_sound(const WorkingMap& map, VertexId v);

/// Share of the surface times f(T, d); infinite where the image is folded.
double triangle_energy(const WorkingMap& map, TriangleId t);
double total_energy(const WorkingMap& map);
/// Sum of the energies of all triangles with a corner among `vertices`, each once.
double energy_around(const WorkingMap& map, const std::vector<VertexId>& vertices);
/// Sum of the energies of the triangles.
double energy_of(const WorkingMap& map, const std::vector<TriangleId>& triangles);

/// Where a straight line ends that starts in a domain triangle's frame: the triangle that holds the end, the end in its
/// frame, and the motion from there back into the frame of the start.
struct Walked {
  DomainTriangleId home = -1;
  Vec2d at;
  UnitMotion back;
};

/// \return nothing where the line leaves the domain over a boundary
std::optional<Walked> walk(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to);

/// The first side that such a line crosses for which `stop(side, its neighbour)` holds, and where.
struct Crossing {
  DomainSide side;   ///< of the triangle that is left
  double share = 0;  ///< of the way along the side
  UnitMotion back;   ///< from the frame of the triangle that is left into the frame of the start
};
template <typename Stop>
std::optional<Crossing> walk_until(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to, Stop&& stop);

/// The map on the lattice of the file; the domain renumbered without gaps.
Parameterization finished(const WorkingMap& map);

/// One straight step of a walk: out of `frame` over its first side on the way, or none where the line ends inside.
struct SideCrossed {
  int side = -1;
  double along = 0;  ///< share of the line before the side
};
SideCrossed first_side_on(const Vec2d& from, const Vec2d& to);

template <typename Stop>
std::optional<Crossing> walk_until(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to, Stop&& stop) {
  constexpr int kMostTriangles = 64;
  UnitMotion back;
  for (int step = 0; step < kMostTriangles; ++step) {
    const SideCrossed crossed = first_side_on(from, to);
    if (crossed.side < 0) return std::nullopt;
    const DomainSide side{frame, crossed.side};
    const DomainSide n = domain.neighbour(side);
    if (!n.exists()) return std::nullopt;
    from += (to - from) * crossed.along;
    if (stop(side, n)) return Crossing{side, to_corner_frame(crossed.side)(from).x, back};
    const UnitMotion& across = unit_transition(n.side, crossed.side);
    from = across(from);
    to = across(to);
    back = composed(back, unit_transition(crossed.side, n.side));
    frame = n.triangle;
  }
  return std::nullopt;
}

}  // namespace lozenge
