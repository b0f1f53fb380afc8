// The nodes, skins and animations of a glTF file that something needs, as a rig.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/gltf/morph_targets.h"
#include "formats/surface/rig.h"

namespace lozenge {

/// \param nodes  of the file, parents before children, with all that are above them
/// \param skins  of the file, whose joints are all among `nodes`
/// \param targets  [node of the file] the morph targets that its mesh has, whose weights animations move
/// \param notes  gets sentences about what can't be taken along: channels of other properties, animations that are
/// broken \throws Error(kUnusableInput) where a node's transform is none, or a skin's matrices are not what they should
/// be;
///         Error(kLimit) where animations hold more numbers than any asset has
Rig read_rig(const GltfFile& file, const std::vector<int>& nodes, const std::vector<int>& skins,
             const std::vector<MeshTargets>& targets, std::vector<std::string>& notes);

}  // namespace lozenge
