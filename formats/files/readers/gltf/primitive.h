// One primitive of a glTF mesh as plain triangles with their vertices' attributes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/surface/primitive.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// How messages call a primitive: "mesh 0 primitive 1".
std::string primitive_place(int mesh, int primitive);

/// Whether its mode is triangles, strip or fan.
bool holds_triangles(const GltfFile& file, int mesh, int primitive);

/// Vertices and triangles that it would have, from the counts of its accessors alone.
struct PrimitiveSize {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t used_vertices = 0;  ///< at most, by those
};
/// \throws Error(kUnusableInput) where it has no POSITION
PrimitiveSize primitive_size(const GltfFile& file, int mesh, int primitive);

/// \pre it holds triangles
/// \throws Error(kUnusableInput) naming mesh and primitive: no POSITION, attributes of the wrong type or number,
/// positions that
///         aren't finite, indices past the vertices
/// \param joints  that are kept of those that move a vertex
Primitive read_primitive(const GltfFile& file, int mesh, int primitive, int joints = kMostJoints);

/// The same with the vertices alone that its triangles use, in their order: exporters let many primitives share
/// accessors that hold the vertices of all. With morph targets all vertices are there.
Primitive read_used_vertices(const GltfFile& file, int mesh, int primitive, int joints = kMostJoints);

/// The box of its positions: as its accessor says, or, where that says nothing or `exactly` is set, of all that are
/// used.
Bounds primitive_extent(const GltfFile& file, int mesh, int primitive, bool exactly);

/// Another attribute of floats of the same primitive.
/// \throws Error(kUnusableInput) where it is missing, or of another type or number than `components` for each vertex
std::vector<float> read_custom_attribute(const GltfFile& file, int mesh, int primitive, const std::string& attribute,
                                         int components);

}  // namespace lozenge
