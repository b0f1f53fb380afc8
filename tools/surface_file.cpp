#include "tools/surface_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/base/error.h"
#include "formats/files/asset_places.h"
#include "formats/files/asset_pose.h"
#include "formats/files/file_kind.h"
#include "formats/files/geometry_image_file.h"
#include "formats/patches/level_mesh.h"
#include "formats/surface/boundary.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

using Triangles = std::vector<std::array<VertexId, 3>>;

std::vector<VertexId> vertices_of(const Triangles& triangles) {
  std::vector<VertexId> vertices;
  for (const auto& corners : triangles) vertices.insert(vertices.end(), corners.begin(), corners.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Appends some triangles of the surface once more, elsewhere.
void add_copy(Surface& surface, const Triangles& triangles, const std::vector<VertexId>& vertices,
              const Placement& place) {
  const auto first = static_cast<VertexId>(surface.positions.size());
  for (const VertexId v : vertices) surface.positions.push_back(placed(place, surface.positions[v]));
  const auto moved = [&](VertexId v) {
    return first + static_cast<VertexId>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  const bool mirrors = is_mirroring(place);
  for (const auto& [a, b, c] : triangles) {
    surface.triangles.push_back({moved(a), moved(mirrors ? c : b), moved(mirrors ? b : c)});
  }
}

/// Shows bodies in all of their places. \param owner  of a triangle, by its number: a body, or -1
template <typename Owner>
void add_copies(Surface& surface, const std::vector<Body>& bodies, const Owner& owner) {
  std::vector<Triangles> triangles(bodies.size());
  for (std::size_t t = 0; !bodies.empty() && t < surface.triangles.size(); ++t) {
    const std::int32_t body = owner(t);
    if (body >= 0 && bodies[body].places.size() > 1) triangles[body].push_back(surface.triangles[t]);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    require_sensible_copies(triangles[b].size(), bodies[b].places.size());
    const std::vector<VertexId> vertices = vertices_of(triangles[b]);
    for (const Placement& copy : copies_of(bodies[b])) add_copy(surface, triangles[b], vertices, copy);
  }
}

Surface surface_of_image(const std::filesystem::path& file, int level) {
  const GeometryImage image = read_geometry_image(file);
  require_level(file, level, image.levels.size());
  LevelMesh mesh = level_mesh(image, level);
  Surface surface{std::move(mesh.positions), std::move(mesh.triangles), image.layout.translation};
  add_copies(surface, image.layout.bodies.bodies,
             [&](std::size_t t) { return image.layout.bodies.owner_of(mesh.patches[t]); });
  return surface;
}

Surface surface_of_asset(const std::filesystem::path& file, int level, const std::optional<Pose>& pose) {
  const Asset asset = posed_or_not(read_asset(file), pose, file);
  require_level(file, level, asset.levels.size());
  AssetLevel shown = with_copies(asset.levels[level]);
  const std::vector<VertexId> welded = welded_vertices(shown.positions);
  return {std::move(shown.positions), renumbered(std::move(shown.triangles), welded), asset.translation};
}

Surface surface_of_import(const std::filesystem::path& file, const std::optional<Pose>& pose) {
  SourceMesh mesh = posed_or_not(import_surface(file, {.fill_holes = 0}), pose);
  Surface surface{std::move(mesh.positions), std::move(mesh.triangles), mesh.translation};
  add_copies(surface, mesh.bodies.bodies, [&](std::size_t t) { return mesh.bodies.owner_of(mesh.materials[t]); });
  return surface;
}

}  // namespace

void count_from(const Vec3d& origin, const Vec3d& translation, std::vector<Vec3f>& positions) {
  if (origin == translation) return;
  for (Vec3f& p : positions) p = Vec3f(Vec3d(p) + (translation - origin));
}

void require_level(const std::filesystem::path& file, int level, std::size_t levels) {
  if (level >= 0 && static_cast<std::size_t>(level) < levels) return;
  throw Error(ExitCode::kUsage, fmt::format("{}: has no level of detail {}; its levels are 0 to {}",
                                            file.filename().string(), level, static_cast<long long>(levels) - 1));
}

SourceMesh posed_or_not(SourceMesh mesh, const std::optional<Pose>& pose) {
  return pose ? in_pose(mesh, *pose) : std::move(mesh);
}

Asset posed_or_not(Asset asset, const std::optional<Pose>& pose, const std::filesystem::path& file) {
  return pose ? in_pose(std::move(asset), *pose, file.filename().string()) : std::move(asset);
}

Surface read_surface(const std::filesystem::path& file, int level, const std::optional<Pose>& pose) {
  // A .gltf is JSON and not one of our own kinds, but it holds a surface.
  if (file.extension() == ".gltf") return surface_of_import(file, pose);
  const FileKind kind = recognise_file(file);
  switch (kind) {
    case FileKind::kSourceMesh:
    case FileKind::kForeignMesh:
    case FileKind::kParameterization:
      return surface_of_import(file, pose);
    case FileKind::kGeometryImage:
      if (pose) {
        throw Error(ExitCode::kUsage,
                    file.filename().string() + ": a geometry image stands at rest; its animations are in the asset");
      }
      return surface_of_image(file, level);
    case FileKind::kAsset:
      return surface_of_asset(file, level, pose);
    default:
      throw Error(
          ExitCode::kUnusableInput,
          fmt::format(
              "{}: is a {}, which holds no surface; give an asset (glTF, PLY, OBJ, STL, OFF) or a geometry image",
              file.filename().string(), name_of(kind)));
  }
}

}  // namespace lozenge
