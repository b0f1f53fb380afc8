// A place moves positions as its matrix says, normals by the inverse's transpose, and tangents with the surface; where
// the matrix mirrors, triangles and the bitangent's sign turn round. A skin has a matrix for each vertex.
#include "formats/files/asset_places.h"

#include <cmath>

#include "formats/surface/normal_transform.h"
#include "formats/surface/rig.h"

namespace lozenge {

namespace {

Vec3f unit_or_same(const Vec3d& v, const Vec3f& same) {
  const double length = v.length();
  return length > 0 && std::isfinite(length) ? Vec3f(v / length) : same;
}

/// A vector of a vertex with what morph targets add to it; the same bits where that is nothing.
Vec3f morphed(const Vec3f& given, const AssetLevel& level, std::vector<Vec3f> AssetTarget::*what,
              const std::vector<double>& weights, std::size_t v) {
  Vec3d sum(given);
  bool changed = false;
  for (std::size_t t = 0; t < weights.size(); ++t) {
    const std::vector<Vec3f>& deltas = level.targets[t].*what;
    if (weights[t] == 0 || deltas.empty()) continue;
    sum += Vec3d(deltas[v]) * weights[t];
    changed = true;
  }
  return changed ? Vec3f(sum) : given;
}

/// Appends vertex `v` of a level, moved; the same bits where nothing moves it.
void append_vertex(const AssetLevel& level, std::size_t v, const Imath::M44d& matrix,
                   const std::vector<double>& weights, AssetLevel& to) {
  const NormalTransform normal(matrix);
  const Vec3f position = morphed(level.positions[v], level, &AssetTarget::offsets, weights, v);
  to.positions.emplace_back(placed(matrix, Vec3d(position)));
  if (!level.normals.empty()) {
    to.normals.push_back(normal(morphed(level.normals[v], level, &AssetTarget::normals, weights, v)));
  }
  if (!level.tangents.empty()) {
    const Vec4f& t = level.tangents[v];
    const Vec3f given = morphed({t.x, t.y, t.z}, level, &AssetTarget::tangents, weights, v);
    const Vec3d turned = placed(matrix, Vec3d(given)) - placed(matrix, Vec3d(0, 0, 0));
    const Vec3f unit = normal.is_identity ? given : unit_or_same(turned, given);
    to.tangents.emplace_back(unit.x, unit.y, unit.z, normal.mirrored ? -t.w : t.w);
  }
  if (!level.uvs.empty()) to.uvs.push_back(level.uvs[v]);
}

/// Appends one place of a part of a level.
void append_place(const AssetLevel& level, const AssetPart& part, const Placement& place, AssetLevel& to) {
  const Imath::M44d matrix = matrix_of(place);
  const bool mirrors = part.joints.empty() && is_mirroring(place);
  const auto shift = static_cast<VertexId>(to.positions.size()) - static_cast<VertexId>(part.first_vertex);
  for (std::size_t v = part.first_vertex; v < part.first_vertex + part.vertices; ++v) {
    append_vertex(level, v, part.joints.empty() ? matrix : blended(part.joints, level.influence(v)), part.weights, to);
  }
  for (std::size_t t = part.first_triangle; t < part.first_triangle + part.triangles; ++t) {
    const auto [a, b, c] = level.triangles[t];
    to.triangles.push_back({a + shift, (mirrors ? c : b) + shift, (mirrors ? b : c) + shift});
    if (!level.materials.empty()) to.materials.push_back(level.materials[t]);
  }
}

AssetLevel in_places(const AssetLevel& level, bool all) {
  AssetLevel shown;
  shown.name = level.name;
  shown.material = level.material;
  for (const AssetPart& part : level.parts) append_place(level, part, part.places.front(), shown);
  for (const AssetPart& part : level.parts) {
    if (!all) break;
    require_sensible_copies(part.triangles, part.places.size());
    for (std::size_t p = 1; p < part.places.size(); ++p) append_place(level, part, part.places[p], shown);
  }
  return shown;
}

}  // namespace

AssetLevel at_rest(const AssetLevel& level) { return in_places(level, false); }

AssetLevel with_copies(const AssetLevel& level) { return in_places(level, true); }

}  // namespace lozenge
