// Which instances of an asset's meshes make up which body, and which of them only say where the surface of another one
// is to be seen again.
#pragma once

#include <Imath/ImathMatrix.h>

#include <cstdint>
#include <vector>

#include "formats/files/readers/input_asset.h"
#include "formats/surface/bodies.h"

namespace lozenge {

struct FoundBodies {
  std::vector<Body> bodies;
  std::vector<std::int32_t> body_of;  ///< [instance] the one of `bodies` that it is surface of, or -1
  std::vector<bool> is_copy;          ///< [instance] whether it is a further place of a body, and no surface
};

/// All that a skin places is one body; all of a node that moves is one; all of a node whose mesh has morph targets is
/// one, whose surface nothing else shares. Of each mesh, the first placement that may be
/// shared is surface, and the others that may be are further places of it, those that move and those that stand still
/// each among themselves. One that is sheared against the first, which no node of a glTF can say by itself, is surface
/// of its own.
/// \param may_be_shared  [instance]; not where it touches something else of its body, for it may be joined with that
/// \param standing       `standing_transforms` of the asset's rig
FoundBodies find_bodies(const InputAsset& asset, const std::vector<bool>& may_be_shared,
                        const std::vector<Imath::M44d>& standing);

/// Before that is known: a number for each instance, such that only instances of equal numbers may have a body in
/// common as surface; -1 for all that stands still.
std::vector<std::int32_t> apart(const InputAsset& asset);

}  // namespace lozenge
