// Assets of several parts: each is parameterized on its own, with the share of the domain that its area asks for, and
// the maps are put together.
//
// In the paper a surface is one; nothing in it couples two that don't touch but the number of domain triangles, and
// the scale that all of them share. A part gets triangles in proportion to its area, so that both are kept as nearly as
// whole numbers allow, and at least as many as its topology needs.
#pragma once

#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/parameterize.h"

namespace lozenge {

/// A connected piece of a surface.
struct Part {
  SourceMesh mesh;
  std::vector<VertexId> vertices;  ///< [vertex of the part] its number in the whole, ascending by first use
  double area = 0;
};

/// Whether all triangles hang together by shared vertices.
bool is_connected(const SourceMesh& mesh);

/// The pieces of a surface that hang together by shared vertices, in the order of their first triangles.
std::vector<Part> split_into_parts(const SourceMesh& mesh);

/// A part with its map. What stays empty in one part's attributes must in all.
struct MappedPart {
  SourceMesh surface;
  Parameterization map;
};

/// All of them as one surface with one map onto one domain, in canonical form.
MappedPart join_parts(std::vector<MappedPart> parts);

/// The map of a surface onto itself: a domain triangle for each of its triangles.
Parameterization map_to_itself(const SourceMesh& mesh);

/// How many triangles a part's domain may have.
struct Allotment {
  std::int32_t min_faces = 0;
  std::int32_t max_faces = 0;
  /// The part's triangles are its domain: it is tiny, and has no more of them than a few.
  bool is_itself = false;
};

/// Shares min_faces to max_faces out by area, and at least what its topology needs.
/// \return [part]
std::vector<Allotment> allot(const std::vector<Part>& parts, std::int32_t min_faces, std::int32_t max_faces);

/// What the weighed distortion (paper, eq. 6) of the whole would be, were the largest part's domain the one of a row of
/// its trace: as far as their shares allow, the others get domain triangles as large as it has then, and what they get
/// beyond that is a distortion of areas. Within themselves they are taken to be as distorted as the largest. \param
/// largest  its number
double weighed_whole(const std::vector<Part>& parts, const std::vector<Allotment>& shares, std::size_t largest,
                     const TraceRow& row);

}  // namespace lozenge
