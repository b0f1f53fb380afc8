// The parameterization stage: an abstract domain of equilateral triangles for a surface, and an almost isometric map
// onto it (the paper, Sections 4 and 5).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/base/progress.h"
#include "formats/domain/distortion.h"
#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/domain_size.h"
#include "stages/parameterize/map/energy.h"
#include "stages/parameterize/search/trace.h"

namespace lozenge {

struct ParameterizeOptions {
  /// The domain gets the number of triangles, in this interval, where the aggregate distortion times the square root of
  /// that number is least (paper, eq. 6). It gets more where the topology or the shape of the surface asks for more,
  /// and no more than the surface has. Both 0: an interval that follows from the source (`domain_faces`).
  std::int32_t min_domain_faces = 0;
  std::int32_t max_domain_faces = 0;
  EnergyKind energy = EnergyKind::kIsometric;
  double gamma = 3;  ///< weight of areas against angles in the isometric energy (paper, eq. 4)
  /// How irregular stars are laid into the plane while their vertices crawl: 0 keeps areas, 1 keeps angles (Sec. 4.1).
  double star_conformality = 0;
  /// Optimize over the three partitions in turn, as in Sec. 5.5, instead of all vertices at once: slower, to compare.
  bool partitions_in_turn = false;
  /// Source edges longer than this share of a domain triangle's side (of the largest domain in the interval, were all
  /// its triangles equal) are split; 0: none. Of domains of more than 200 triangles a larger share
  /// (`enough_triangles`).
  double longest_edge = 0.2;
  /// Vertices of the source that stay vertices of the domain through all collapses (the hybrid of Sec. 7.2). At least
  /// one domain triangle touches each; more than the domain can have keep it larger than asked for.
  std::vector<VertexId> cones;
  /// The domain is found on a proxy of so many triangles for each of the domain's (`ProxySize`); 0: on the surface
  /// itself.
  double proxy_triangles_per_face = 40;
};

struct ParameterizeResult {
  /// The surface that the map is of: the source itself, or, where some of its edges are long beside the domain's
  /// triangles or join two vertices of the boundary through the inside, the same surface with those edges split
  /// (`split_long_edges`, `split_chords`).
  SourceMesh surface;
  Parameterization map;
  Distortion distortion;
  /// No domain of fewer triangles has the surface's topology (or, where parts are tiny, leaves them what they are).
  std::int32_t least_domain_faces = 0;
  std::int32_t parts_as_they_are = 0;  ///< so small, or so plain, that their own triangles or faces are their domain
  /// The interval that the domain was looked for in; empty where several parts shared what their source leaves room
  /// for.
  FaceRange asked;
  /// Over the interval, from the most faces to the fewest; of several parts, those of the largest one.
  std::vector<TraceRow> trace;
  std::vector<double> energies;  ///< of the final optimization: before it, and after each epoch; never rises
};

/// Parameterizes an oriented 2-manifold surface of any genus, of one component or several, closed or with boundaries,
/// which map to boundaries of the domain. Several components share the domain by their areas (`parts.h`). No triangle
/// is folded, and the images tile the domain exactly: both are proved in integers before the map is handed out. \throws
/// Error(kUsage) where the options make no sense, Error(kInternal) where no such map was found
ParameterizeResult parameterize(SourceMesh source, const ParameterizeOptions& options, const Progress& progress);

/// How many triangles the domain of a surface of so many shall have, by its source or by the user; several parts may
/// get more.
FaceRange domain_faces(const ParameterizeOptions& options, std::int64_t triangles);

/// What to tell a user whose range the domain missed: why, and what to ask for. Empty where it lies in it, or below.
std::string note_on_domain_size(const ParameterizeResult& made, const ParameterizeOptions& options);

}  // namespace lozenge
