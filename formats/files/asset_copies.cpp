// A copy moves positions as its matrix says, normals by the inverse's transpose, and tangents with the surface; where
// the matrix mirrors, triangles and the bitangent's sign turn round.
#include "formats/files/asset_copies.h"

#include <cmath>

#include "formats/surface/normal_transform.h"

namespace lozenge {

namespace {

Imath::M44d matrix_of(const Placement& m) {
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
}

Vec3f unit_or_same(const Vec3d& v, const Vec3f& same) {
  const double length = v.length();
  return length > 0 && std::isfinite(length) ? Vec3f(v / length) : same;
}

/// Appends one placement of a part of a level.
void append_copy(const AssetLevel& level, const AssetRepeat& repeat, const Placement& copy, AssetLevel& to) {
  const Vec3d x(copy[0], copy[1], copy[2]);
  const Vec3d y(copy[4], copy[5], copy[6]);
  const Vec3d z(copy[8], copy[9], copy[10]);
  const NormalTransform normal(matrix_of(copy));
  const auto shift = static_cast<VertexId>(to.positions.size()) - static_cast<VertexId>(repeat.first_vertex);
  for (std::size_t v = repeat.first_vertex; v < repeat.first_vertex + repeat.vertices; ++v) {
    to.positions.push_back(placed(copy, level.positions[v]));
    if (!level.normals.empty()) to.normals.push_back(normal(level.normals[v]));
    if (!level.tangents.empty()) {
      const Vec4f& t = level.tangents[v];
      const Vec3f turned = unit_or_same(x * t.x + y * t.y + z * t.z, {t.x, t.y, t.z});
      to.tangents.emplace_back(turned.x, turned.y, turned.z, normal.mirrored ? -t.w : t.w);
    }
    if (!level.uvs.empty()) to.uvs.push_back(level.uvs[v]);
  }
  for (std::size_t t = repeat.first_triangle; t < repeat.first_triangle + repeat.triangles; ++t) {
    const auto [a, b, c] = level.triangles[t];
    to.triangles.push_back({a + shift, (normal.mirrored ? c : b) + shift, (normal.mirrored ? b : c) + shift});
  }
}

}  // namespace

AssetLevel with_copies(const AssetLevel& level) {
  AssetLevel all = level;
  all.repeats.clear();
  for (const AssetRepeat& repeat : level.repeats) {
    require_sensible_copies(repeat.triangles, repeat.copies.size());
    for (const Placement& copy : repeat.copies) append_copy(level, repeat, copy, all);
  }
  return all;
}

}  // namespace lozenge
