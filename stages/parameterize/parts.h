// The pieces of a surface that don't touch, and putting them together again.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

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

/// A part with its map, whose first levels are left to `first_level`. What stays empty in one part's attributes must in
/// all.
struct MappedPart {
  SourceMesh surface;
  Parameterization map;
  std::int32_t first_level = 0;
};

/// All of them as one surface with one map onto one domain, in canonical form. The domain has the parts of the largest
/// scale first, the surface the order in which they come.
/// \param like  says what no part does: the names of materials, and what the asset said about itself
MappedPart join_parts(std::vector<MappedPart> parts, const SourceMesh& like);

}  // namespace lozenge
