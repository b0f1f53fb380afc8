// The surface in any file that holds one.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "formats/files/asset_file.h"
#include "formats/surface/pose.h"
#include "formats/surface/surface_view.h"

namespace lozenge {

struct Surface {
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> triangles;
  Vec3d translation{0, 0, 0};  ///< what takes positions to the scene

  SurfaceView view() const { return {positions, triangles}; }
};

/// Positions that something takes to the scene, counted from another origin there.
void count_from(const Vec3d& origin, const Vec3d& translation, std::vector<Vec3f>& positions);

/// The surface with its vertices welded; of an asset of somebody else's, as the importer makes it, but for its holes,
/// which stay. So surfaces end where the map of them does, on both sides of a cut.
/// \param level  of detail, of a geometry image or an asset; 0 is the finest
/// \param pose   of its animations; nothing: at rest
/// \throws Error(kUsage) where the file has no such level or animation; Error(kUnusableInput) where it holds no surface
Surface read_surface(const std::filesystem::path& file, int level, const std::optional<Pose>& pose = std::nullopt);

/// An imported surface, and an asset, in a pose or at rest.
SourceMesh posed_or_not(SourceMesh mesh, const std::optional<Pose>& pose);
Asset posed_or_not(Asset asset, const std::optional<Pose>& pose, const std::filesystem::path& file);

/// \throws Error(kUsage) where `level` isn't one of `levels`, naming the file
void require_level(const std::filesystem::path& file, int level, std::size_t levels);

}  // namespace lozenge
