#include "formats/surface/source_mesh.h"

#include <algorithm>

namespace lozenge {

double triangle_area(const std::vector<Vec3f>& positions, const std::array<VertexId, 3>& triangle) {
  const Vec3d p(positions[triangle[0]]);
  return (Vec3d(positions[triangle[1]]) - p).cross(Vec3d(positions[triangle[2]]) - p).length() / 2;
}

double surface_area(const std::vector<Vec3f>& positions, const std::vector<std::array<VertexId, 3>>& triangles) {
  double area = 0;
  for (const auto& t : triangles) {
    if (t[0] >= 0) area += triangle_area(positions, t);
  }
  return area;
}

bool is_double_sided(const SourceMesh& mesh) {
  if (mesh.double_sided.empty()) return false;
  return std::any_of(mesh.materials.begin(), mesh.materials.end(),
                     [&](std::int32_t material) { return mesh.double_sided[material]; });
}

Bounds bounds_of(const std::vector<Vec3f>& positions) {
  if (positions.empty()) return {};
  Bounds box{positions.front(), positions.front()};
  for (const Vec3f& p : positions) {
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

double diagonal(const Bounds& bounds) { return (Vec3d(bounds.high) - Vec3d(bounds.low)).length(); }

std::vector<Vec3f> vertex_normals(const SourceMesh& mesh) {
  std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0, 0, 0));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d p(mesh.positions[a]);
    const Vec3d n = (Vec3d(mesh.positions[b]) - p).cross(Vec3d(mesh.positions[c]) - p);
    sums[a] += n;
    sums[b] += n;
    sums[c] += n;
  }
  std::vector<Vec3f> normals(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double length = sums[v].length();
    normals[v] = length > 0 ? Vec3f(sums[v] / length) : Vec3f(0, 0, 0);
  }
  return normals;
}

ShadingNormals::ShadingNormals(const SourceMesh& mesh)
    : mesh_(mesh), corners_(find_stream(mesh.corner_attributes, kNormals)) {
  if (!corners_) smooth_ = vertex_normals(mesh);
}

Vec3f ShadingNormals::at(TriangleId t, const Vec3d& weights) const {
  Vec3d sum(0, 0, 0);
  for (int c = 0; c < 3; ++c) {
    const Vec3f n = corners_
                        ? vector_at<Vec3f>(*corners_, 3 * static_cast<std::size_t>(t) + static_cast<std::size_t>(c))
                        : smooth_[mesh_.triangles[t][c]];
    sum += Vec3d(n) * weights[c];
  }
  const double length = sum.length();
  if (length > 0) return Vec3f(sum / length);
  const auto& [a, b, c] = mesh_.triangles[t];
  const Vec3d p(mesh_.positions[a]);
  const Vec3d face = (Vec3d(mesh_.positions[b]) - p).cross(Vec3d(mesh_.positions[c]) - p);
  return face.length() > 0 ? Vec3f(face.normalized()) : Vec3f(0, 0, 1);
}

}  // namespace lozenge
