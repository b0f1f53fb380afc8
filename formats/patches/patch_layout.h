// Where patches lie on the domain and beside each other: one for each domain edge, over its half-diamond (paper, Sec.
// 4.2).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/domain/domain.h"
#include "formats/domain/parameterization.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {

/// Where a patch lies on the domain: the half-diamond of an edge that runs from domain vertex a to domain vertex b.
///
/// (u, v) = (0, 0) is a, (1, 0) the barycentre of the right triangle, (1, 1) is b, (0, 1) the barycentre of the left
/// one; in between the map is affine, so u = v is the domain edge. Sample (i, j) of N x N is (u, v) = (i, j) / (N - 1).
/// Sides 0..3 run counter-clockwise from (0, 0): v = 0, u = 1, v = 1, u = 0.
struct PatchPlace {
  DomainVertex a = -1;
  DomainVertex b = -1;
  DomainSide left;   ///< the side from a to b: the triangle where v >= u
  DomainSide right;  ///< the side from b to a: the triangle where v <= u; none at the surface's boundary
};

/// Distance to the source (root mean square) that is good enough where nobody says otherwise, in percent of the
/// diagonal of its bounding box.
inline constexpr double kUsualError = 0.05;

/// As many triangles as a level of detail is worth that is to show all of a source of so many: 1.5 times as many from
/// 50,000 on, 2.5 times from 2,000 on, and 4 times below. A level with more has lost, however near it is.
constexpr std::int64_t worthwhile_triangles(std::int64_t source) {
  return source >= 50'000 ? source + source / 2 : source >= 2'000 ? 2 * source + source / 2 : 4 * source;
}

/// The side of a neighbouring patch; patch -1 where there is none.
struct PatchSide {
  std::int32_t patch = -1;
  std::int32_t side = -1;
  friend bool operator==(const PatchSide&, const PatchSide&) = default;
};

/// How what lies on a patch is drawn: bit 0 is set where it is to be seen from both sides; the bits above are its alpha
/// mode, 0 opaque.
using MaterialClass = std::int32_t;
inline constexpr MaterialClass kDoubleSidedClass = 1;
inline constexpr MaterialClass kMostMaterialClass = 5;

/// The patches of a surface, whatever is sampled on them, and what goes on being said about the surface.
struct PatchLayout {
  std::int32_t samples = 0;        ///< N, a side, of patches whose first level is 0: 2^k + 1, both borders included
  std::vector<PatchPlace> places;  ///< [patch]
  std::vector<std::array<PatchSide, 4>> adjacency;  ///< [patch][side], reciprocal
  /// [patch] the finest level of detail that has it: there it has (N - 1) / 2^k + 1 samples a side, k the first level.
  /// The same all over a connected part, ascending; empty: 0 everywhere.
  std::vector<std::int32_t> first_levels;
  Bodies bodies;  ///< [patch]
  /// [patch] of most of its samples; empty: 0 everywhere.
  std::vector<MaterialClass> material_classes;

  /// What takes the samples' positions to the source's coordinates: for sources far from the origin, where floats are
  /// coarse, positions are around a local one.
  Vec3d translation{0, 0, 0};
  Bounds bounds;  ///< of the source mesh, as the samples' positions are
  /// Root mean square of the distance of the samples' mesh to the source, in percent of the diagonal of its bounding
  /// box; nothing where nobody measured it.
  std::optional<double> deviation;
  /// Of the asset's own surface, before edges were split for its map.
  std::int64_t source_triangles = 0;
  std::string scene_name;     ///< of the source mesh
  std::string origin;         ///< of the source mesh
  bool double_sided = false;  ///< whether any of the source is to be seen from both sides

  std::int32_t size() const { return static_cast<std::int32_t>(places.size()); }
  std::int32_t first_level(std::int32_t patch) const { return first_levels.empty() ? 0 : first_levels[patch]; }
  /// The level whose samples show a patch where `level` is drawn: a patch that doesn't exist there is drawn as on its
  /// first.
  std::int32_t shown_level(std::int32_t patch, std::int32_t level) const { return std::max(level, first_level(patch)); }
  /// Samples a side of a patch, where `level` is drawn.
  std::int32_t samples_of(std::int32_t patch, std::int32_t level = 0) const {
    return ((samples - 1) >> shown_level(patch, level)) + 1;
  }
  /// Triangles of a patch, where `level` is drawn.
  std::int64_t triangles_of(std::int32_t patch, std::int32_t level) const {
    const std::int64_t steps = samples_of(patch, level) - 1;
    return (places[patch].right.exists() ? 2 : 1) * steps * steps;
  }
  /// Of all patches.
  std::int64_t count_triangles(std::int32_t level) const {
    std::int64_t count = 0;
    for (std::int32_t patch = 0; patch < size(); ++patch) count += triangles_of(patch, level);
    return count;
  }
  /// How many patches exist on a level: the first so many.
  std::int32_t count_on(std::int32_t level) const {
    if (first_levels.empty()) return size();
    return static_cast<std::int32_t>(std::upper_bound(first_levels.begin(), first_levels.end(), level) -
                                     first_levels.begin());
  }
};

/// The patches of the domain onto which `mesh` is mapped, in the order of `edges(domain)`; left is the lower side.
/// A part's first level is the map's, or the last one for which the steps between samples can be halved. Which bodies
/// patches belong to, and what their materials are, is still to be found.
PatchLayout patch_layout(const SourceMesh& mesh, const Parameterization& map, std::int32_t samples);

/// What is wrong with first levels that come from a file, in words, or nothing: one for each patch (or none at all),
/// from 0 to what leaves 2 samples a side, ascending, and equal wherever patches touch. \pre the adjacency is sound
std::optional<std::string> find_first_level_defect(const PatchLayout& layout);

/// [patch] where the patches of a domain lie, in the order of `edges(domain)`.
std::vector<PatchPlace> patch_places(const Domain& domain);

/// The part of a patch that lies in one triangle: named by the triangle's side.
struct PatchHalf {
  std::int32_t patch = -1;
  bool left = true;

  /// The patch side along the segment from the side's first corner to the barycentre.
  PatchSide at_start() const { return {patch, left ? 3 : 1}; }
  /// The same at its second corner.
  PatchSide at_end() const { return {patch, left ? 2 : 0}; }
};

/// [3 * triangle + side] \pre as for `patch_adjacency`
std::vector<PatchHalf> patch_halves(const std::vector<PatchPlace>& places);

/// [patch][side] the neighbours that follow from the places alone: in each triangle, the segment from a corner to the
/// barycentre is a side of the patch whose edge starts in that corner, and of the one whose edge ends there. \pre the
/// places name every side of every triangle exactly once
std::vector<std::array<PatchSide, 4>> patch_adjacency(const std::vector<PatchPlace>& places);

/// What is wrong with places that come from a file, in words that name the patch, or nothing: every side of triangles
/// 0..T-1 is named exactly once, and the triangles' corners agree with the vertices a and b.
std::optional<std::string> find_place_defect(const std::vector<PatchPlace>& places);

/// Visits the triangles of a patch's mesh in their order, which is row by row: `visit` takes three samples, each as its
/// {i, j}, counter-clockwise. Quad (i, j) is split along its short diagonal, from (i + 1, j) to (i, j + 1), into (i,
/// j), (i + 1, j), (i, j + 1) and (i + 1, j + 1), (i, j + 1), (i + 1, j). Of a patch that has no right side (`half`),
/// only the part v >= u exists; a quad on its diagonal gives the one triangle (i, i), (i + 1, i + 1), (i, i + 1).
template <typename Visit>
void for_each_patch_triangle(std::int32_t samples, bool half, Visit visit) {
  using Sample = std::array<std::int32_t, 2>;
  for (std::int32_t j = 0; j + 1 < samples; ++j) {
    for (std::int32_t i = 0; i + 1 < samples; ++i) {
      const Sample a{i, j};
      const Sample b{i + 1, j};
      const Sample c{i, j + 1};
      const Sample d{i + 1, j + 1};
      if (half && i > j) break;
      if (half && i == j) {
        visit(a, d, c);
      } else {
        visit(a, b, c);
        visit(d, c, b);
      }
    }
  }
}

}  // namespace lozenge
