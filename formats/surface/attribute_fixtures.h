// Attributes of corners as vectors, and attributes that nothing but a test knows: for tests of whatever carries them
// along.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "formats/surface/attribute_streams.h"
#include "formats/surface/source_mesh.h"

namespace lozenge::fixtures {

/// A stream as vectors; of no elements where there is none.
template <typename Vector>
class CornerVectors {
 public:
  CornerVectors(const SourceMesh& mesh, const AttributeKind& kind)
      : stream_(find_stream(mesh.corner_attributes, kind)) {}

  std::size_t size() const { return stream_ ? stream_->count() : 0; }
  bool empty() const { return size() == 0; }
  Vector operator[](std::size_t corner) const { return vector_at<Vector>(*stream_, corner); }
  bool operator==(const CornerVectors& other) const {
    return empty() ? other.empty() : !other.empty() && stream_->values == other.stream_->values;
  }

 private:
  const AttributeStream* stream_;
};

inline CornerVectors<Vec3f> corner_normals(const SourceMesh& mesh) { return {mesh, kNormals}; }
inline CornerVectors<Vec2f> corner_uvs(const SourceMesh& mesh) { return {mesh, kTextureCoordinates}; }
inline CornerVectors<Vec4f> corner_colors(const SourceMesh& mesh) { return {mesh, kColors}; }

/// Gives the next corner that has none yet its value.
template <typename Vector>
void add_corner(SourceMesh& mesh, const AttributeKind& kind, const Vector& value) {
  AttributeStream& stream = stream_for(mesh.corner_attributes, kind);
  for (unsigned c = 0; c < Vector::dimensions(); ++c) stream.values.push_back(value[static_cast<int>(c)]);
}
template <typename Vector>
void set_corner(SourceMesh& mesh, const AttributeKind& kind, std::size_t corner, const Vector& value) {
  float* at = stream_for(mesh.corner_attributes, kind).at(corner);
  for (unsigned c = 0; c < Vector::dimensions(); ++c) at[c] = value[static_cast<int>(c)];
}

inline bool same_bits(const AttributeStreams& a, const AttributeStreams& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t s = 0; s < a.size(); ++s) {
    const std::vector<float>& of_a = a[s].values;
    const std::vector<float>& of_b = b[s].values;
    if (!(a[s].kind == b[s].kind) || a[s].set != b[s].set || of_a.size() != of_b.size()) return false;
    if (!of_a.empty() && std::memcmp(of_a.data(), of_b.data(), of_a.size() * sizeof(float)) != 0) return false;
  }
  return true;
}

// One kind of each interpolation that no table has.
inline constexpr AttributeKind kHeat{.semantic = "_HEAT", .label = "heat", .components = 2};
inline constexpr AttributeKind kFlow{
    .semantic = "_FLOW", .label = "flow", .components = 3, .interpolation = Interpolation::kDirection};
inline constexpr AttributeKind kBones{
    .semantic = "_BONES", .label = "bones", .components = 8, .interpolation = Interpolation::kJointsAndWeights};
inline constexpr AttributeKind kTag{
    .semantic = "_TAG", .label = "tags", .interpolation = Interpolation::kNearest, .neutral = -1};
inline constexpr std::array kPlantedKinds{kHeat, kFlow, kBones, kTag};

/// Gives all corners attributes that follow from their positions: heat linearly, all else everywhere the same.
inline void plant_attributes(SourceMesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const VertexId v : triangle) {
      const Vec3f& p = mesh.positions[v];
      add_corner(mesh, kHeat, Vec2f(p.x + 2 * p.y, p.y - p.z));
      add_corner(mesh, kFlow, Vec3f(0, 0.6F, 0.8F));
      std::vector<float>& bones = stream_for(mesh.corner_attributes, kBones).values;
      bones.insert(bones.end(), {5, 9, 0, 0, 0.75F, 0.25F, 0, 0});
      stream_for(mesh.corner_attributes, kTag).values.push_back(7);
    }
  }
}

/// After whatever became of the mesh.
inline void expect_planted_attributes(const SourceMesh& mesh) {
  for (const AttributeKind& kind : kPlantedKinds) {
    const AttributeStream* stream = find_stream(mesh.corner_attributes, kind);
    ASSERT_NE(stream, nullptr) << kind.semantic;
    ASSERT_EQ(stream->values.size(), 3 * mesh.triangles.size() * static_cast<std::size_t>(kind.components));
  }
  const CornerVectors<Vec2f> heat(mesh, kHeat);
  const CornerVectors<Vec3f> flow(mesh, kFlow);
  const std::vector<float> bones{5, 9, 0, 0, 0.75F, 0.25F, 0, 0};
  for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) {
    const Vec3f& p = mesh.positions[mesh.triangles[c / 3][c % 3]];
    // Rounding to floats, of positions and values, some times over.
    const float rounding = 1e-5F * (1 + p.length());
    ASSERT_LT((heat[c] - Vec2f(p.x + 2 * p.y, p.y - p.z)).length(), rounding);
    ASSERT_LT((flow[c] - Vec3f(0, 0.6F, 0.8F)).length(), 1e-6F);
    const float* b = find_stream(mesh.corner_attributes, kBones)->at(c);
    ASSERT_EQ(std::vector<float>(b, b + 8), bones);
    ASSERT_EQ(*find_stream(mesh.corner_attributes, kTag)->at(c), 7);
  }
}

}  // namespace lozenge::fixtures
