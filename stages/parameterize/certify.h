// From floating point to the file's lattice: the finished map, and the proof that it is one.
#pragma once

#include <optional>

#include "formats/domain/distortion.h"
#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"
#include "stages/parameterize/map/working_map.h"

namespace lozenge {

/// A map on the file's lattice, proved to be one, and how distorted it is.
struct ProvedMap {
  Parameterization map;
  Distortion distortion;
};

/// The map, rounded to the lattice; no triangle is folded and the images tile the domain, proved in integers.
///
/// Rounding may turn the thinnest triangles over, and around a cone of three or four domain triangles a wide source
/// triangle may be told by its corners alone to lie on the other side: `develop` takes the shorter way. Corners of the
/// former are moved apart, the latter are split, in `mesh` as well, whose vertices may then be numbered anew. \pre
/// `map` is of all of `mesh` \return nothing, with `mesh` unchanged, where that doesn't help
std::optional<ProvedMap> certified(WorkingMap& map, SourceMesh& mesh);

/// Brings the mesh into canonical form, and its map along.
void make_canonical_with_map(SourceMesh& mesh, Parameterization& map);

}  // namespace lozenge
