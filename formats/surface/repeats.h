// Meshes that an asset places more than once. Their surface is parameterized, sampled and baked once, where one of the
// placements has it; the others are matrices, which the exported asset's nodes have again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// An affine map in the order of a glTF node's `matrix`: the images of the three axes, then that of the origin, each
/// followed by a 0, the last by a 1.
using Placement = std::array<double, 16>;

inline constexpr Placement kUnmoved = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Vec3f placed(const Placement& placement, const Vec3f& position);

/// Whether it mirrors: triangles turn over.
bool is_mirroring(const Placement& placement);

/// Whether a glTF node can have it: it is finite, affine, keeps volume from vanishing, and turns the axes as a whole (a
/// translation, a rotation and a scale, but no shear).
bool is_node_transform(const Placement& placement);

struct RepeatedMesh {
  std::string name;               ///< of the asset's mesh
  std::vector<Placement> copies;  ///< from the surface to where each further placement has it
};

/// The repeated meshes of a surface, and what of it is theirs.
struct Repeats {
  std::vector<RepeatedMesh> meshes;
  /// [material of a mesh, or patch] which of `meshes` it belongs to, or -1; empty where `meshes` is.
  std::vector<std::int32_t> owner;

  bool empty() const { return meshes.empty(); }
  std::int32_t owner_of(std::size_t i) const { return owner.empty() ? -1 : owner[i]; }
};

/// For what is to hold each copy with triangles of its own.
/// \throws Error(kLimit) where that is more than a file from a stranger should be able to ask memory for
void require_sensible_copies(std::size_t triangles_of_mesh, std::size_t copies);

/// What is wrong with repeats from a file that has `count` materials or patches, in words, or nothing.
std::optional<std::string> find_defect(const Repeats& repeats, std::size_t count);

}  // namespace lozenge
