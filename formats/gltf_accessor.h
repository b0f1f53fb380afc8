// The values of glTF accessors as flat arrays: strides, component types, normalization and sparse parts undone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/gltf_model.h"

namespace lozenge {

/// Components of every element as floats, element by element; integers that are normalized become 0..1 or -1..1.
/// \param components  that the accessor must have (1 scalar, 2..4 vectors); 0 takes what it has
/// \param place       how messages call it: "mesh 0 primitive 1, POSITION"
/// \throws Error(kUnusableInput) where the accessor is of another type
std::vector<float> read_floats(const GltfFile& file, int accessor, int components, const std::string& place);

/// Unsigned integers, widened.
/// \param bound  every value must be below; messages say that there are so many vertices
std::vector<std::uint32_t> read_indices(const GltfFile& file, int accessor, std::uint64_t bound,
                                        const std::string& place);

/// Number of elements and of components of one.
std::uint64_t accessor_count(const GltfFile& file, int accessor);
int accessor_components(const GltfFile& file, int accessor);

}  // namespace lozenge
