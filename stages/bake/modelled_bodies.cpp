#include "stages/bake/modelled_bodies.h"

#include <cmath>

#include "formats/surface/pose.h"

namespace lozenge {

namespace {

std::size_t slot_in(const SourceMesh& mesh, TriangleId t) {
  return mesh.bodies.empty() ? 0 : static_cast<std::size_t>(mesh.bodies.owner_of(mesh.materials[t]) + 1);
}

std::vector<std::vector<std::array<VertexId, 3>>> triangles_of_bodies(const SourceMesh& mesh) {
  std::vector<std::vector<std::array<VertexId, 3>>> triangles(mesh.bodies.bodies.size() + 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    triangles[slot_in(mesh, static_cast<TriangleId>(t))].push_back(mesh.triangles[t]);
  }
  return triangles;
}

}  // namespace

ModelledBodies::ModelledBodies(const SourceMesh& mesh) : mesh_(as_modelled(mesh)), normals_(mesh_) {
  for (const auto& triangles : triangles_of_bodies(mesh)) {
    scenes_.emplace_back(mesh_.positions, triangles);
    const double modelled = surface_area(mesh_.positions, triangles);
    const double standing = surface_area(mesh.positions, triangles);
    units_.push_back(standing > 0 && modelled > 0 ? std::sqrt(modelled / standing) : 1);
  }
}

std::size_t ModelledBodies::slot_of(TriangleId t) const { return slot_in(mesh_, t); }

OcclusionPoint ModelledBodies::at(const SourcePoint& point) const {
  const auto& [a, b, c] = mesh_.triangles[point.triangle];
  const Vec3d p(mesh_.positions[a]);
  const Vec3d face = (Vec3d(mesh_.positions[b]) - p).cross(Vec3d(mesh_.positions[c]) - p);
  const Vec3d normal(normals_.at(point.triangle, point.weights));
  // Where a body's own space mirrors it, its triangles are turned over.
  const double length = face.dot(normal) < 0 ? -face.length() : face.length();
  return {Vec3d(position_at(mesh_, point)), length != 0 ? face / length : Vec3d(0, 0, 0), normal};
}

}  // namespace lozenge
