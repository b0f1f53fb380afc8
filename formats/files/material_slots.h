// Where glTF's material names the texture of each slot. For .cpp files alone: it includes tinygltf.
#pragma once

#include <tiny_gltf.h>

#include "formats/patches/map_kinds.h"

namespace lozenge {

/// The index of the texture in a slot, -1 for none. \pre the slot is one
int texture_in(const tinygltf::Material& material, MaterialSlot slot);

/// Whether the material may have a texture there: one of an extension, only where it has the extension.
bool has_slot(const tinygltf::Material& material, MaterialSlot slot);

/// \pre has_slot(material, slot)
void set_texture(tinygltf::Material& material, MaterialSlot slot, int texture);

}  // namespace lozenge
