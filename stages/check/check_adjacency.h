// What a patch set and a geometry image share: where patches lie on the domain, and which sides touch.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "formats/patches/patch_layout.h"
#include "stages/check/check_report.h"

namespace lozenge {

/// Lines "adjacency is reciprocal" and "adjacency follows the domain".
/// \return whether both hold, so that samples may be looked up across sides
bool check_adjacency(const std::vector<PatchPlace>& places, const std::vector<std::array<PatchSide, 4>>& adjacency,
                     CheckReport& report);

/// Sample k of a side, counted from where the side starts: its (i, j).
std::array<std::int32_t, 2> sample_on_side(std::int32_t side, std::int32_t k, std::int32_t samples);

/// The domain as its patches tell it. \pre `check_adjacency` held
struct PatchedDomain {
  std::int64_t vertices = 0;
  std::int64_t edges = 0;
  std::int64_t triangles = 0;
  std::vector<std::int32_t> valence;  ///< [domain vertex] edges that meet there
  std::vector<bool> on_boundary;      ///< [domain vertex] the surface ends there
  std::int64_t irregular = 0;         ///< see `is_irregular`
  std::int64_t half_patches = 0;      ///< on the boundary

  bool closed() const { return half_patches == 0; }
  std::int64_t euler() const { return vertices - edges + triangles; }
  /// Another valence than 6; on the boundary, where three triangles are regular, than 4.
  bool is_irregular(DomainVertex v) const { return valence[v] != (on_boundary[v] ? 4 : 6); }
};
PatchedDomain domain_of_patches(const std::vector<PatchPlace>& places);

/// False where (i, j) lies beyond the surface's boundary: in the half that the patch doesn't have.
inline bool has_sample(const PatchPlace& place, std::int32_t i, std::int32_t j) {
  return place.right.exists() || j >= i;
}

/// True where a float is finite in all components.
bool is_finite(const Vec3f& v);
/// True where the length is 1 to the rounding of floats.
bool is_unit(const Vec3f& v);
/// True where all bits are equal: -0 and +0 differ.
bool same_bits(const Vec3f& a, const Vec3f& b);

}  // namespace lozenge
