// The map phi: M -> D (paper, Sec. 3), tabled at the vertices of the source mesh.
#pragma once

#include <vector>

#include "formats/domain/development.h"
#include "formats/domain/domain.h"
#include "formats/domain/domain_point.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// A domain and the position on it of every vertex of a source mesh. The map is linear on every source triangle, over
/// the interpolation domain that holds its three positions (see `develop`). At every irregular vertex of the domain
/// lies a vertex of the mesh.
struct Parameterization {
  Domain domain;
  std::vector<DomainPoint> phi;  ///< [vertex of the source mesh]
};

/// Flat image of triangle `t` of the source mesh; nothing where the map is broken there.
std::optional<Development> image_of(const SourceMesh& mesh, const Parameterization& map, TriangleId t);

}  // namespace lozenge
