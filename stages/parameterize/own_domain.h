// Domains that a surface brings along: its own triangles, or, of a box and its like, its own faces.
#pragma once

#include <optional>

#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// The map of a surface onto itself: a domain triangle for each of its triangles.
Parameterization map_to_itself(const SourceMesh& mesh);

/// The map of a box whose patches are its six faces, onto four domain triangles: domain vertices on four corners, no
/// two of them on one edge, and the other four corners on the barycentres. The half-diamond of each domain edge (paper,
/// Sec. 4.2) is a face then, and with two samples a side the patches are the box.
///
/// The same of any closed surface whose triangles pair up into nearly flat, convex quadrangles, with vertices of two
/// kinds that alternate around each of them, and those of one kind touching three: each is the barycentre of a domain
/// triangle. (A wedge, a frustum, a rhombic dodecahedron.)
/// \return nothing where the surface isn't of that kind
/// \pre the surface is connected
std::optional<Parameterization> map_to_its_faces(const SourceMesh& mesh);

}  // namespace lozenge
