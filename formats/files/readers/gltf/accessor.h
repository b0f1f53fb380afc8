// The values of glTF accessors as flat arrays: strides, component types, normalization and sparse parts undone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/surface/attribute.h"

namespace lozenge {

/// What an accessor says that it holds.
struct AccessorFacts {
  std::uint64_t count = 0;  ///< elements
  int components = 0;       ///< of one element: 1 scalar, 2..4 vectors, 4, 9, 16 matrices
  bool is_float = false;
  bool is_signed = false;   ///< of integers
  bool normalized = false;  ///< of integers
};
AccessorFacts accessor_facts(const GltfFile& file, int accessor);

/// Whether an attribute may be kept in numbers of this type. \param is_quantized  the file uses KHR_mesh_quantization
bool may_hold(Integers integers, const AccessorFacts& facts, bool is_quantized);

/// Components of every element as floats, element by element; integers that are normalized become 0..1 or -1..1, others
/// keep their value. \pre the accessor is a scalar or a vector
std::vector<float> read_floats(const GltfFile& file, int accessor);

/// The same of some elements alone, which is what it costs. \param elements  ascending, below its count
std::vector<float> read_floats_of(const GltfFile& file, int accessor, const std::vector<std::uint32_t>& elements);

/// Indices of a primitive, widened.
/// \param vertices  every index must be below
/// \param place     how messages call the primitive: "mesh 0 primitive 1"
/// \throws Error(kUnusableInput) where the accessor holds no unsigned integers, or an index is past the vertices
std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor, std::uint64_t vertices,
                                        const std::string& place);

}  // namespace lozenge
