// From where the surface of a body stands to the space that an asset has its mesh in.
#pragma once

#include <Imath/ImathMatrix.h>

#include <vector>

#include "formats/surface/placement.h"
#include "formats/surface/rig.h"
#include "stages/export/asset_levels.h"
#include "stages/export/engine_mesh.h"

namespace lozenge {

/// Moves the meshes of all parts that something moves to where it moves them from. Without a rig all stay where they
/// are. \throws Error(kUnusableInput) where a part is moved by what the rig hasn't got
void move_to_own_spaces(std::vector<LeveledPart>& parts, const Rig& rig, const Vec3d& translation);

/// Moves all vertices from the scene to the space of which this is the placement; where that mirrors, triangles turn.
void move_to_own_space(EngineMesh& mesh, const Placement& placement);

/// Moves each vertex to where its joints bring it back from, so that the skin at rest shows the mesh as it stood. The
/// weights become those that the file holds, multiples of 1 / 65535 that add up to 1.
/// \param joints  `standing_joints` of the skin
void move_to_space_of_skin(EngineMesh& mesh, const std::vector<Imath::M44d>& joints);

/// The largest number of a weight in the file, which stands for 1.
inline constexpr int kWholeWeight = 65535;

}  // namespace lozenge
