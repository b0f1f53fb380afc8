// Maps in the middle of their making, for the tests of this stage.
#pragma once

#include <vector>

#include "formats/surface/source_mesh.h"
#include "stages/parameterize/levels/removal.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge::test {

/// What a map must be at any time, coarse as it may be: the domain sound, every image of positive area and agreeing
/// with its neighbours', and the images' areas adding up to the domain's.
void expect_sound(const WorkingMap& map);

/// And what it must be in the end: the same proved exactly, by positions on the lattice.
void expect_whole(const WorkingMap& map, const SourceMesh& mesh);

/// The domain's defects, if any, with removed triangles and vertices left out.
void expect_sound_domain(const WorkingMap& map);

/// The trivial map of a mesh (which must outlive it), decimated to so many domain triangles. Without `removals` on the
/// mesh itself, else on a proxy, and what was removed is appended.
WorkingMap decimated_map(const SourceMesh& mesh, int faces, std::vector<Removal>* removals = nullptr);

}  // namespace lozenge::test
