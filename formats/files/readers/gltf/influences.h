// Joints and weights of a skinned primitive, all sets of them, as one stream (glTF 2.0 specification, Sec. 3.7.3.3).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/surface/attribute.h"

namespace tinygltf {
struct Primitive;
}

namespace lozenge {

/// Names of the accessors of each set in Lozenge's own mesh files, which have no skinned nodes.
inline constexpr std::array kStoredJoints{"_LOZENGE_JOINTS", "_LOZENGE_JOINTS_1"};
inline constexpr std::array kStoredWeights{"_LOZENGE_WEIGHTS", "_LOZENGE_WEIGHTS_1"};

/// Elements of `kInfluences` for each vertex: of JOINTS_n and WEIGHTS_n the heaviest, each joint once, whose weights
/// add up to 1. What is no weight (negative, not finite) counts as 0; a vertex without any weight belongs to its first
/// joint. Empty where the primitive has none of both, or of other types than glTF allows, or for another number of
/// vertices. \param most  joints that are kept; of Lozenge's own files all are
std::vector<float> read_influences(const GltfFile& file, const tinygltf::Primitive& primitive, std::uint64_t vertices,
                                   int most = kMostJoints);

}  // namespace lozenge
