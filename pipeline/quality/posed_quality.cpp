#include "pipeline/quality/posed_quality.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/files/asset_places.h"
#include "formats/files/asset_pose.h"
#include "formats/surface/boundary.h"
#include "stages/compare/compare.h"

namespace lozenge {

namespace {

/// Enough to tell levels apart, and few enough for all levels in all poses.
constexpr std::int64_t kPoints = 20'000;
constexpr std::size_t kMostAnimations = 4;
constexpr std::size_t kTimes = 2;

/// A level with vertices of equal positions as one.
struct Welded {
  std::vector<Vec3f> positions;
  std::vector<std::array<VertexId, 3>> triangles;

  SurfaceView view() const { return {positions, triangles}; }
};

/// Vertices are one where they are at rest.
Welded welded(const AssetLevel& level, const AssetLevel& rest) {
  return {level.positions, renumbered(level.triangles, welded_vertices(rest.positions))};
}

double mean_distance(const SourceMesh& source, const AssetLevel& level, const AssetLevel& rest) {
  const CompareOptions options{.points = kPoints};
  return compare({source.positions, source.triangles}, welded(level, rest).view(), options).mean_percent();
}

}  // namespace

PosedFacts measure_in_poses(const SourceMesh& source, const Asset& asset, const std::string& name,
                            const Progress& progress) {
  PosedFacts facts;
  std::vector<AssetLevel> rest;
  for (const AssetLevel& level : asset.levels) {
    rest.push_back(at_rest(level));
    facts.levels.push_back({mean_distance(source, rest.back(), rest.back()), 0, 0, 0});
  }
  const std::vector<Pose> poses = sample_poses(source.rig, kMostAnimations, kTimes);
  for (const Pose& pose : poses) {
    report(progress, "compare", static_cast<double>(facts.poses++) / static_cast<double>(poses.size()));
    const SourceMesh moved = in_pose(source, pose);
    const Asset posed = in_pose(asset, pose, name);
    for (std::size_t l = 0; l < posed.levels.size(); ++l) {
      PosedLevel& level = facts.levels[l];
      const double mean = mean_distance(moved, at_rest(posed.levels[l]), rest[l]);
      if (facts.poses == 1 || mean > level.worst_percent) {
        level.worst_percent = mean;
        level.animation = pose.animation;
        level.time = pose.time;
      }
    }
  }
  return facts;
}

std::vector<std::pair<std::string, Picture>> pictures_in_poses(const Asset& asset, const std::string& name,
                                                               const RenderOptions& options) {
  std::vector<std::pair<std::string, Picture>> pictures;
  const bool has_several = asset.rig.animations.size() > 1;
  for (const Pose& pose : sample_poses(asset.rig, has_several ? 2 : 1, has_several ? 1 : 2)) {
    const AssetLevel shown = with_copies(in_pose(asset, pose, name).levels.front());
    const std::string& animation = asset.rig.animations[static_cast<std::size_t>(pose.animation)].name;
    pictures.emplace_back(fmt::format("{} at {:.2f} s", animation.empty() ? "animation" : animation, pose.time),
                          render_surface(welded(shown, with_copies(asset.levels.front())).view(), false, options));
  }
  return pictures;
}

}  // namespace lozenge
