#include "stages/bake/source_tangents.h"

#include <array>
#include <bit>
#include <cmath>
#include <map>

namespace lozenge {

namespace {

Vec3d in_plane(const Vec3d& v, const Vec3d& n) {
  const Vec3d left = v - n * n.dot(v);
  const double length = left.length();
  return length > 0 && std::isfinite(length) ? left / length : Vec3d(0, 0, 0);
}

double angle_between(const Vec3d& a, const Vec3d& b) { return std::atan2(a.cross(b).length(), a.dot(b)); }

/// What corners share that have one tangent: vertex, normal, texture coordinates, handedness.
using Key = std::array<std::uint32_t, 7>;

/// Texture coordinates of a triangle's corners in its normal texture.
std::array<Vec2d, 3> places_of(const AttributeStream& stream, const TextureUse& texture, std::size_t first) {
  std::array<Vec2d, 3> places;
  for (std::size_t c = 0; c < 3; ++c) {
    places[c] = place_in_texture(texture, Vec2d(vector_at<Vec2f>(stream, first + c)));
  }
  return places;
}

Vec3d unit_weight(int corner) { return {corner == 0 ? 1.0 : 0.0, corner == 1 ? 1.0 : 0.0, corner == 2 ? 1.0 : 0.0}; }

}  // namespace

SourceTangents::SourceTangents(const SourceMesh& mesh, const ShadingNormals& normals,
                               const TextureOfTangents& texture_of)
    : mesh_(mesh), tangents_(3 * mesh.triangles.size(), Vec3f(0, 0, 0)), mirrored_(mesh.triangles.size(), false) {
  std::vector<std::optional<TextureUse>> textures;
  for (const Material& material : mesh.material_looks) textures.push_back(texture_of(material));
  const AttributeStream* given = find_stream(mesh.corner_attributes, kTangents);
  std::map<Key, Vec3d> sums;
  std::vector<const Vec3d*> sum_of(tangents_.size(), nullptr);
  for (std::size_t t = 0; t < mesh.triangles.size() && !mesh.material_looks.empty(); ++t) {
    const std::optional<TextureUse>& texture = textures[mesh.materials[t]];
    if (!texture || (given != nullptr && take(*given, t))) continue;
    const AttributeStream* stream = find_stream(mesh.corner_attributes, kTextureCoordinates, texture->set);
    if (stream == nullptr) continue;
    const std::array<Vec2d, 3> uv = places_of(*stream, *texture, 3 * t);
    std::array<Vec3d, 3> p;
    for (int c = 0; c < 3; ++c) p[c] = Vec3d(mesh.positions[mesh.triangles[t][c]]);
    const Vec2d b = uv[1] - uv[0];
    const Vec2d c = uv[2] - uv[0];
    const double area = b.x * c.y - b.y * c.x;
    if (area == 0) continue;
    // v runs down: a texture that isn't mirrored turns the other way around.
    mirrored_[t] = area > 0;
    const Vec3d along_u = ((p[1] - p[0]) * c.y - (p[2] - p[0]) * b.y) * (area > 0 ? 1.0 : -1.0);
    for (int k = 0; k < 3; ++k) {
      const Vec3d n(normals.at(static_cast<TriangleId>(t), unit_weight(k)));
      const Vec3f nf(n);
      const Vec2f uvf(uv[k]);
      const Key key{static_cast<std::uint32_t>(mesh.triangles[t][k]),
                    std::bit_cast<std::uint32_t>(nf.x),
                    std::bit_cast<std::uint32_t>(nf.y),
                    std::bit_cast<std::uint32_t>(nf.z),
                    std::bit_cast<std::uint32_t>(uvf.x),
                    std::bit_cast<std::uint32_t>(uvf.y),
                    mirrored_[t] ? 1U : 0U};
      Vec3d& sum = sums.try_emplace(key, Vec3d(0, 0, 0)).first->second;
      sum += in_plane(along_u, n) * angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
      sum_of[3 * t + static_cast<std::size_t>(k)] = &sum;
    }
  }
  for (std::size_t corner = 0; corner < tangents_.size(); ++corner) {
    if (sum_of[corner] != nullptr && sum_of[corner]->length() > 0) {
      tangents_[corner] = Vec3f(sum_of[corner]->normalized());
    }
  }
}

bool SourceTangents::take(const AttributeStream& given, std::size_t t) {
  std::array<Vec4f, 3> corners;
  for (std::size_t c = 0; c < 3; ++c) {
    corners[c] = vector_at<Vec4f>(given, 3 * t + c);
    if (!(Vec3f(corners[c].x, corners[c].y, corners[c].z).length() > 0)) return false;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    tangents_[3 * t + c] = Vec3f(corners[c].x, corners[c].y, corners[c].z).normalized();
  }
  mirrored_[t] = corners[0].w < 0;
  return true;
}

Vec3d SourceTangents::to_object(TriangleId t, const Vec3d& weights, const Vec3d& normal, const Vec3d& texel) const {
  Vec3d sum(0, 0, 0);
  for (std::size_t c = 0; c < 3; ++c) sum += Vec3d(tangents_[3 * static_cast<std::size_t>(t) + c]) * weights[c];
  const double length = sum.length();
  if (!(length > 0)) return normal;
  const Vec3d tangent = sum / length;
  const Vec3d bitangent = normal.cross(tangent) * (mirrored_[static_cast<std::size_t>(t)] ? -1.0 : 1.0);
  const Vec3d direction = tangent * texel.x + bitangent * texel.y + normal * texel.z;
  return direction.length() > 0 ? direction.normalized() : normal;
}

}  // namespace lozenge
