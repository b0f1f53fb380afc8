#include "pipeline/unwrap/origins.h"

#include <algorithm>
#include <cassert>

#include "formats/base/parallel.h"

namespace lozenge {

namespace {

/// A number in two floats, which hold whole numbers up to 2^24 only.
constexpr AttributeKind kOriginTriangle{.semantic = "_LOZENGE_ORIGIN",
                                        .label = "origins",
                                        .components = 2,
                                        .interpolation = Interpolation::kNearest,
                                        .neutral = -1};
constexpr AttributeKind kOriginWeights{
    .semantic = "_LOZENGE_ORIGIN_WEIGHTS", .label = "weights in origins", .components = 3};
constexpr OriginNumber kLowPart = 1 << 20;

/// Streams for the corners of so many triangles.
void append_origins(AttributeStreams& streams, std::size_t count, OriginNumber first) {
  AttributeStream triangles{kOriginTriangle, 0, {}};
  AttributeStream weights{kOriginWeights, 0, {}};
  triangles.values.reserve(6 * count);
  weights.values.reserve(9 * count);
  for (std::size_t t = 0; t < count; ++t) {
    const OriginNumber number = first + static_cast<OriginNumber>(t);
    for (int corner = 0; corner < 3; ++corner) {
      triangles.values.push_back(static_cast<float>(number % kLowPart));
      triangles.values.push_back(static_cast<float>(number / kLowPart));
      for (int k = 0; k < 3; ++k) weights.values.push_back(k == corner ? 1.0F : 0.0F);
    }
  }
  streams.push_back(std::move(triangles));
  streams.push_back(std::move(weights));
}

}  // namespace

Primitive with_origins(const Primitive& primitive, OriginNumber first) {
  Primitive made;
  made.material = primitive.material;
  const std::size_t corners = 3 * primitive.triangles.size();
  std::vector<std::uint32_t> vertices;
  vertices.reserve(corners);
  for (const auto& t : primitive.triangles) vertices.insert(vertices.end(), t.begin(), t.end());
  made.positions = gathered<std::uint32_t>(primitive.positions, 3, vertices);
  for (const AttributeStream& stream : primitive.attributes) {
    if (!stream.kind.tells_vertices_apart) continue;
    const auto width = static_cast<std::size_t>(stream.kind.components);
    made.attributes.push_back({stream.kind, stream.set, gathered<std::uint32_t>(stream.values, width, vertices)});
  }
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    const auto c = static_cast<std::uint32_t>(3 * t);
    made.triangles.push_back({c, c + 1, c + 2});
  }
  append_origins(made.attributes, primitive.triangles.size(), first);
  return made;
}

void be_own_origin(SourceMesh& mesh) { append_origins(mesh.corner_attributes, mesh.triangles.size(), 0); }

void forget_caps(SourceMesh& mesh) {
  AttributeStream& triangles = stream_for(mesh.corner_attributes, kOriginTriangle);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_cap(mesh, static_cast<TriangleId>(t))) std::fill_n(triangles.at(3 * t), 6, -1.0F);
  }
  mesh.materials.clear();
  mesh.material_names.clear();
  mesh.material_looks.clear();
  mesh.images.clear();
  mesh.cap_of.clear();
  mesh.double_sided.clear();
  mesh.bodies = {};
}

Origins::Origins(const SourceMesh& mesh)
    : triangles_(find_stream(mesh.corner_attributes, kOriginTriangle)),
      weights_(find_stream(mesh.corner_attributes, kOriginWeights)) {
  assert(triangles_ != nullptr && weights_ != nullptr);
}

OriginNumber Origins::of_triangle(TriangleId t) const {
  const float* value = triangles_->at(3 * static_cast<std::size_t>(t));
  if (value[0] < 0) return -1;
  return static_cast<OriginNumber>(value[0]) + kLowPart * static_cast<OriginNumber>(value[1]);
}

Vec3f Origins::weights(std::span<const WeightedElement> corners) const {
  Vec3d sum(0, 0, 0);
  for (const auto& [corner, weight] : corners) sum += Vec3d(vector_at<Vec3f>(*weights_, corner)) * weight;
  return Vec3f(sum);
}

}  // namespace lozenge
