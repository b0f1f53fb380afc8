// What morph targets do to the vertices of an asset's meshes. Each vertex knows where it lies on the source, so offsets
// and normals are the source's there; tangents follow from the surface that a target makes and from the atlas.
#pragma once

#include <vector>

#include "formats/surface/source_mesh.h"
#include "stages/export/asset_levels.h"

namespace lozenge {

/// Gives the parts whose body has morph targets in the source those, and their vertices what they do, in the scene's
/// space. Vertices of a part whose positions have equal bits are moved by equal bits. Normals change where the source
/// says so, or has none.
void add_morph_deltas(std::vector<LeveledPart>& parts, const SourceMesh& source);

/// Finds what targets do to tangents: those of the surface with all of a target's offsets, less those without.
/// \pre  the parts are in spaces of their own
void add_tangent_deltas(std::vector<LeveledPart>& parts);

}  // namespace lozenge
