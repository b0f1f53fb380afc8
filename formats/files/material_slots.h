// Where glTF's material names the texture of each slot. For .cpp files alone: it includes tinygltf.
#pragma once

#include <tiny_gltf.h>

#include "formats/patches/map_kinds.h"

namespace lozenge {

/// The index of the texture in a slot, -1 for none. \pre the slot is one
int& texture_in(tinygltf::Material& material, MaterialSlot slot);
int texture_in(const tinygltf::Material& material, MaterialSlot slot);

}  // namespace lozenge
