// Vertices and indices of a GLB in meshoptimizer's codec: extension EXT_meshopt_compression.
#pragma once

#include <string>

namespace lozenge {

/// The same file with buffer views of vertices and triangles compressed, where that makes them smaller; nothing that is
/// decoded is another, but for which corner a triangle begins with. Who doesn't know the extension finds a buffer
/// without bytes in their place (its rule on fallback buffers), and so the extension is required.
/// \pre the bytes of a GLB as tinygltf writes it: a JSON chunk and a binary one, which is its only buffer; an accessor
/// of vertex attributes or indices has a view of its own
std::string with_meshopt_compression(const std::string& glb);

}  // namespace lozenge
