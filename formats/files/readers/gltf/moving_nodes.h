// Which nodes of a scene move, and which others that needs.
#pragma once

#include <string>
#include <vector>

#include "formats/files/readers/gltf/model.h"
#include "formats/files/readers/gltf/morph_targets.h"
#include "formats/files/readers/input_asset.h"

namespace lozenge {

/// The rig of a scene of which some surface moves: nodes that an animation moves (one that never leaves the rest value
/// moves nothing) or that are joints of a skin, all that are below these (what hangs on a bone stays there, be it an
/// empty node or a light), and all that are above. Says of each instance which of its
/// nodes or skins moves it; of those whose mesh has morph targets, at which node weights are animated, and what weights
/// they have at rest. A node with a skin whose mesh has no joints and weights is one without a skin.
/// \param notes  gets sentences about what isn't taken along
/// \throws Error as `read_rig`, and where a skin has joints that are no nodes
/// \param targets  [mesh] `find_targets`
Rig find_rig(const GltfFile& file, const std::vector<MeshTargets>& targets, std::vector<InputInstance>& instances,
             std::vector<std::string>& notes);

}  // namespace lozenge
