// The map phi: M -> D (paper, Sec. 3), tabled at the vertices of the source mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
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
  /// [domain triangle] k, where the domain's triangles of its connected part count as scaled by 2^-k: a small part has
  /// small domain triangles, so that samples lie as close on it as on the others. The same all over a part, ascending
  /// over the domain, 0 to kMostFirstLevel; empty: 0 everywhere.
  std::vector<std::int32_t> first_levels = {};
  /// Triangles of the asset's own surface, before edges were split for the map; 0 where nobody said.
  std::int64_t source_triangles = 0;

  std::int32_t first_level(DomainTriangleId t) const { return first_levels.empty() ? 0 : first_levels[t]; }
};

/// The smallest parts' domain triangles are 2^-5 times as long as the largest ones'.
inline constexpr std::int32_t kMostFirstLevel = 5;

/// What an area counts on domain triangles of this first level: 4^-k.
inline double area_at_level(std::int32_t level) { return 1.0 / static_cast<double>(std::int64_t{1} << (2 * level)); }

/// The domain's area, in triangles of the largest scale.
double scaled_size(const Parameterization& map);

/// How many parts (triangles that hang together by sides) begin on each level, [first level], up to the last that any
/// has.
std::vector<std::int64_t> parts_by_first_level(const Parameterization& map);

/// What is wrong with first levels that come from a file, in words, or nothing: one for each triangle (or none at all),
/// in range, ascending, and equal wherever triangles touch.
std::optional<std::string> find_first_level_defect(const Domain& domain, const std::vector<std::int32_t>& first_levels);

/// Flat image of triangle `t` of the source mesh; nothing where the map is broken there.
std::optional<Development> image_of(const SourceMesh& mesh, const Parameterization& map, TriangleId t);

}  // namespace lozenge
