// Readers of the plain formats in which meshes for research come. Each takes the whole text or bytes of a file, of
// which nothing is trusted, and fills a PolygonMesh.
#pragma once

#include <string>
#include <string_view>

#include "tools/bench/polygon_mesh.h"

namespace lozenge::bench {

/// Geomview's OFF in ASCII, with any of the prefixes ST, C and N; what follows positions and corners is left out.
/// \throws Error(kUnusableInput) naming the line where the text isn't OFF, Error(kUnsupported) for binary OFF and for
///         points of other than 3 coordinates
void read_off(std::string_view text, const std::string& file, PolygonMesh& mesh);

/// Wavefront OBJ: v and f, with negative indices, and the forms v/vt/vn; everything else is left out.
/// \throws Error(kUnusableInput) naming the line
void read_obj(std::string_view text, const std::string& file, PolygonMesh& mesh);

/// PLY in ASCII and in binary of either byte order: x, y, z of the element `vertex`, and the list `vertex_indices` or
/// `vertex_index` of the element `face`, all of any type; everything else is left out.
/// \throws Error(kUnusableInput) where the header or the data are broken
void read_ply(std::string_view bytes, const std::string& file, PolygonMesh& mesh);

/// STL as text and in binary; the three corners of each triangle are vertices of their own.
/// \throws Error(kUnusableInput) where it is neither, or breaks off
void read_stl(std::string_view bytes, const std::string& file, PolygonMesh& mesh);

}  // namespace lozenge::bench
