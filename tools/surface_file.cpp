#include "tools/surface_file.h"

#include <fmt/format.h>

#include "formats/asset_file.h"
#include "formats/boundary.h"
#include "formats/error.h"
#include "formats/file_kind.h"
#include "formats/geometry_image_file.h"
#include "formats/level_mesh.h"
#include "stages/import/import_surface.h"

namespace lozenge {
namespace {

Surface surface_of_image(const std::filesystem::path& file, int level) {
  const GeometryImage image = read_geometry_image(file);
  require_level(file, level, image.levels.size());
  LevelMesh mesh = level_mesh(image, level);
  return {std::move(mesh.positions), std::move(mesh.triangles)};
}

Surface surface_of_asset(const std::filesystem::path& file, int level) {
  Asset asset = read_asset(file);
  require_level(file, level, asset.levels.size());
  Surface surface{std::move(asset.levels[level].positions), std::move(asset.levels[level].triangles)};
  const std::vector<VertexId> vertex = welded_vertices(surface.positions);
  for (auto& corners : surface.triangles) {
    for (VertexId& v : corners) v = vertex[v];
  }
  return surface;
}

Surface surface_of_gltf(const std::filesystem::path& file) {
  SourceMesh mesh = import_surface(file, {.fill_holes = 0});
  return {std::move(mesh.positions), std::move(mesh.triangles)};
}

}  // namespace

void require_level(const std::filesystem::path& file, int level, std::size_t levels) {
  if (level >= 0 && static_cast<std::size_t>(level) < levels) return;
  throw Error(ExitCode::kUsage, fmt::format("{}: has no level of detail {}; its levels are 0 to {}",
                                            file.filename().string(), level, static_cast<long long>(levels) - 1));
}

Surface read_surface(const std::filesystem::path& file, int level) {
  // A .gltf is JSON and not one of our own kinds, but it holds a surface.
  if (file.extension() == ".gltf") return surface_of_gltf(file);
  const FileKind kind = recognise_file(file);
  switch (kind) {
    case FileKind::kSourceMesh:
    case FileKind::kParameterization:
      return surface_of_gltf(file);
    case FileKind::kGeometryImage:
      return surface_of_image(file, level);
    case FileKind::kAsset:
      return surface_of_asset(file, level);
    default:
      throw Error(ExitCode::kUnusableInput,
                  fmt::format("{}: is a {}, which holds no surface; give a glTF or a geometry image",
                              file.filename().string(), name_of(kind)));
  }
}

}  // namespace lozenge
