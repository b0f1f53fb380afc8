// A primitive of a glTF document whose triangles are cut: the vertices that it has and some between them, with other
// texture coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/base/vector.h"
#include "formats/files/gltf_rewrite.h"

namespace lozenge {

/// A vertex by the old ones that it lies between, whose weights add up to 1.
struct VertexBetween {
  std::array<std::uint32_t, 3> vertices{};
  std::array<double, 3> weights{1, 0, 0};
  Vec2f uv{0, 0};
  /// Where it is, if not where the weights put it: vertices of several primitives may be one point of a surface.
  std::optional<Vec3f> position;

  bool is_old() const { return weights[0] == 1; }
};

struct CutPrimitive {
  int mesh = -1;
  int primitive = -1;
  std::vector<std::array<VertexBetween, 3>> triangles;
};

/// Gives the primitives other triangles. Every attribute and morph target is interpolated as its meaning asks for
/// (directions stay of unit length, the heaviest joints stay, whole numbers are those of the nearest vertex) and kept
/// in its type; vertices are shared where all of that agrees by bits. Texture coordinates number `set` are the new
/// ones, and so are those of lower numbers that a primitive doesn't have. Tangents go where they belonged to that set.
/// \pre indices name vertices
void rewrite_primitives(GltfRewrite& rewrite, GltfDocument& document, const std::vector<CutPrimitive>& primitives,
                        int set);

}  // namespace lozenge
