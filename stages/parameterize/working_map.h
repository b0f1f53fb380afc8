// The map while it is being built: a source mesh whose connectivity may change (levels), a domain whose connectivity
// changes (collapses and flips), and the position on the domain of every source vertex.
//
// Positions are kept as (home triangle, point in its frame). Nothing about the way from one triangle to another is
// stored: `place` finds it from the domain's adjacency, over the smallest interpolation domain that holds both (paper,
// Sec. 4.1), so that the domain may change under the map. A source vertex that is pinned lies exactly on a domain
// vertex; at an irregular domain vertex (a cone) there always is one, so that no source triangle has a cone inside, and
// every triangle has a flat image.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "formats/domain.h"
#include "formats/parameterization.h"
#include "formats/source_mesh.h"
#include "stages/parameterize/energy.h"
#include "stages/parameterize/halfedge_mesh.h"
#include "stages/parameterize/plane_motion.h"

namespace lozenge {

/// Most domain triangles around one vertex. A cone of 12 and more has room for two fans of source triangles that each
/// turn all the way around it, and then no place from which a vertex that is put back there sees its neighbours.
inline constexpr int kMostValence = 10;

/// What the energy needs of a source triangle: T = sum of weight[i] * |image of the side opposite corner i|^2, and
/// d = (doubled image area) * inverse_area, both before the scale of the whole surface is applied.
struct RestShape {
  std::array<float, 3> weight{};
  float inverse_area = 0;  ///< of the doubled area
  float share = 0;         ///< of the whole surface's area
};

struct WorkingMap {
  const std::vector<Vec3f>* positions = nullptr;  ///< [source vertex]
  HalfedgeMesh mesh;
  std::vector<RestShape> rest;  ///< [triangle of `mesh`]
  double surface_area = 0;

  Domain domain;                        ///< removed triangles have corners -1
  std::int32_t domain_faces = 0;        ///< those that are left
  std::vector<DomainCorner> corner_of;  ///< [domain vertex] one of its corners; triangle -1 where it is removed
  std::vector<VertexId> anchor;         ///< [domain vertex] the source vertex pinned there, or -1

  std::vector<DomainTriangleId> home;  ///< [source vertex]
  std::vector<Vec2d> at;               ///< [source vertex] in the frame of its home
  std::vector<DomainVertex> pin;       ///< [source vertex] the domain vertex that it is pinned to, or -1

  std::vector<VertexId> first_in;  ///< [domain triangle] list of the vertices at home there, or -1
  std::vector<VertexId> next_in;   ///< [source vertex]
  std::vector<VertexId> last_in;   ///< [source vertex] the one before it

  Energy energy;
  double star_conformality = 0;  ///< of the star domains that irregular vertices crawl in (StarShape)

  /// What T and d are multiplied with, so that the whole surface has the domain's area.
  double scale() const { return surface_area / (domain_faces * 0.5 * kHalfRoot3); }
};

/// The trivial map (paper, Sec. 5.1, start-up): one domain triangle for each source triangle, every vertex pinned.
WorkingMap trivial_map(const std::vector<Vec3f>& positions, HalfedgeMesh mesh);

/// The map of a finished parameterization, to go on with.
WorkingMap working_map(const SourceMesh& mesh, const Parameterization& map);

/// Rest shapes of all triangles of `map.mesh`, and their total area.
void measure_rest_shapes(WorkingMap& map);
RestShape rest_shape(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& triangle, double surface_area);

/// Moves a vertex: into the list of its new home, unpinned.
void set_home(WorkingMap& map, VertexId v, DomainTriangleId home, const Vec2d& at);
/// Pins a vertex to a domain vertex (which must have no anchor), or lets go of it.
void pin_to(WorkingMap& map, VertexId v, DomainVertex corner);
void unpin(WorkingMap& map, VertexId v);

/// Number of domain triangles around the vertex.
int valence(const WorkingMap& map, DomainVertex v);

/// Position of vertex `w` in the frame of domain triangle `frame`, seen from the point `from` there (which decides
/// between two ways around a vertex of few triangles: the shorter is taken). Looks through a face, a diamond or a star
/// that holds both, else through one around a triangle beside the frame: edges that long are found on coarse levels
/// only.
std::optional<Vec2d> place(const WorkingMap& map, VertexId w, DomainTriangleId frame, const Vec2d& from);

/// The neighbours of a vertex, counter-clockwise, in one frame. Triangle i lies between neighbours i and i + 1.
struct Ring {
  std::vector<VertexId> vertices;
  std::vector<Vec2d> at;
  std::vector<Halfedge> halfedges;  ///< from the centre to neighbour i, in triangle i
  /// A neighbour lies further than a triangle away or in a corner: where it is seen may change when the centre moves.
  bool reaches_far = false;

  std::size_t size() const { return vertices.size(); }
};

/// \return false where a neighbour shares no star with the frame
bool gather_ring(const WorkingMap& map, VertexId v, DomainTriangleId frame, const Vec2d& at, Ring& ring);

/// A source triangle's corners, laid out in the frame of one domain triangle.
struct FlatImage {
  DomainTriangleId frame = -1;
  std::array<Vec2d, 3> at;

  double doubled_area() const { return cross(at[1] - at[0], at[2] - at[0]); }
};

/// The flat image of a source triangle, in the frame of one of its corners' homes; nothing where it has none.
std::optional<FlatImage> flat_image(const WorkingMap& map, TriangleId t);

/// Twice the area of the image; -1 where there is none.
double doubled_image_area(const WorkingMap& map, TriangleId t);

/// The triangles around a vertex have images of positive area, and these agree on the lengths of all their sides with
/// each other and with the triangles beyond: nothing around is folded, or seen the wrong way around a cone.
bool is_sound(const WorkingMap& map, VertexId v);

/// f(T, d) of one triangle times its share of the area; infinite where its image is folded or missing.
double triangle_energy(const WorkingMap& map, TriangleId t);

/// Sum of `triangle_energy` over the whole mesh: 1 for an isometry.
double total_energy(const WorkingMap& map);

/// Walks from a point of a frame along a straight line to a point that may lie outside; \return the triangle that holds
/// it, and the point in its frame; nothing where the line leaves through too many triangles.
struct Walked {
  DomainTriangleId home;
  Vec2d at;
};
std::optional<Walked> walk(const Domain& domain, DomainTriangleId frame, Vec2d from, Vec2d to);

/// The result, with removed domain triangles and vertices squeezed out, and positions on the lattice.
/// \pre `map.mesh` has all the vertices of the source mesh
Parameterization finished(const WorkingMap& map);

}  // namespace lozenge
