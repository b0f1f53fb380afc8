// Joints and weights of a skinned primitive, all sets of them, as one stream (glTF 2.0 specification, Sec. 3.7.3.3).
#pragma once

#include <cstdint>
#include <vector>

#include "formats/files/readers/gltf/model.h"

namespace tinygltf {
struct Primitive;
}

namespace lozenge {

/// Names of the two accessors in Lozenge's own mesh files, which have no skinned nodes.
inline constexpr const char* kStoredJoints = "_LOZENGE_JOINTS";
inline constexpr const char* kStoredWeights = "_LOZENGE_WEIGHTS";

/// Elements of `kInfluences` for each vertex: of JOINTS_n and WEIGHTS_n the heaviest, each joint once, whose weights
/// add up to 1. What is no weight (negative, not finite) counts as 0; a vertex without any weight belongs to its first
/// joint. Empty where the primitive has none of both, or of other types than glTF allows, or for another number of
/// vertices.
std::vector<float> read_influences(const GltfFile& file, const tinygltf::Primitive& primitive, std::uint64_t vertices);

}  // namespace lozenge
