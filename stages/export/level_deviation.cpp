// The same places of the source are held against each level; places of the level are spread anew.
#include "stages/export/level_deviation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/base/parallel.h"
#include "formats/surface/nearest_in_row.h"
#include "formats/surface/source_mesh.h"
#include "formats/surface/spread_points.h"
#include "stages/export/charted_scene.h"
#include "stages/export/level_normals.h"

namespace lozenge {

namespace {

/// Of each surface: enough for means of a hundredth, and a small share of what making the level costs.
constexpr std::int64_t kPlaces = 20'000;

/// Distances of one way.
struct Tally {
  double sum = 0;
  double largest = 0;
  double angles = 0;
  std::int64_t count = 0;

  void add(double distance) {
    sum += distance;
    largest = std::max(largest, distance);
    ++count;
  }
  double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
};

/// [body + 1], and of all.
struct Tallies {
  std::vector<Tally> bodies;
  Tally whole;

  explicit Tallies(std::size_t count) : bodies(count) {}
  void add(std::size_t body, double distance) {
    bodies[body].add(distance);
    whole.add(distance);
  }
  void add_angle(std::size_t body, double angle) {
    bodies[body].angles += angle;
    whole.angles += angle;
  }
  void add_largest(std::size_t body, double distance) {
    for (Tally* tally : {&bodies[body], &whole}) tally->largest = std::max(tally->largest, distance);
  }
};

LevelDeviation larger_of(const Tally& there, const Tally& back, double extent, bool has_normals) {
  LevelDeviation made{std::max(there.mean(), back.mean()), std::max(there.largest, back.largest), extent, {}};
  if (has_normals && there.count > 0) made.normals = there.angles / static_cast<double>(there.count);
  return made;
}

LevelDeviations larger_of(const Tallies& there, const Tallies& back, const std::vector<double>& extents, double extent,
                          bool has_normals) {
  LevelDeviations made{larger_of(there.whole, back.whole, extent, has_normals), {}};
  for (std::size_t b = 0; b < extents.size(); ++b) {
    made.bodies.push_back(larger_of(there.bodies[b], back.bodies[b], extents[b], has_normals));
  }
  return made;
}

/// `visit_nearest_in_row` of all numbers below `count`, on all threads.
template <typename Position, typename Visit>
void for_each_nearest(const RayScene& scene, std::size_t count, const Position& position, const Visit& visit) {
  constexpr std::size_t kRow = 256;
  for_each_part(
      count, [&](std::size_t begin, std::size_t end) { visit_nearest_in_row(scene, begin, end, position, visit); },
      kRow);
}

Vec3d position_on(const ChartedSurface& surface, const ChartedTriangle& t, const Vec3d& weights) {
  Vec3d sum(0, 0, 0);
  for (int c = 0; c < 3; ++c) sum += Vec3d(surface.positions[t.corners[c].vertex]) * weights[c];
  return sum;
}

Vec2d place_on(const ChartedTriangle& t, const Vec3d& weights) {
  Vec2d sum(0, 0);
  for (int c = 0; c < 3; ++c) sum += t.corners[c].place * weights[c];
  return sum;
}

std::vector<SurfacePoint> spread(const ChartedSurface& surface) {
  const auto triangles = vertices_of(surface);
  return spread_points({surface.positions, triangles}, kPlaces);
}

}  // namespace

struct DeviationMeter::Place {
  Vec3d position;
  Vec3d normal;  ///< that the source is to show there; of any length
  std::size_t body;
};

DeviationMeter::DeviationMeter(const ChartedSurface& source, const RayScene& scene, const PatchLayout& patches,
                               const LevelNormals* normals)
    : scene_(scene), bodies_(patches.bodies), normals_(normals) {
  for (const SurfacePoint& point : spread(source)) {
    const ChartedTriangle& t = source.triangles[point.triangle];
    const Vec3d normal = normals == nullptr ? Vec3d(0, 0, 1) : normals->of_source(t.patch, place_on(t, point.weights));
    places_.push_back(
        {position_on(source, t, point.weights), normal, static_cast<std::size_t>(bodies_.owner_of(t.patch) + 1)});
  }
  std::vector<std::vector<Vec3f>> corners(bodies_.bodies.size() + 1);
  for (const ChartedTriangle& t : source.triangles) {
    for (const ChartedCorner& c : t.corners) {
      corners[static_cast<std::size_t>(bodies_.owner_of(t.patch) + 1)].push_back(source.positions[c.vertex]);
    }
  }
  for (const auto& of_body : corners) extents_.push_back(of_body.empty() ? 0 : diagonal(bounds_of(of_body)));
  extent_ = diagonal(bounds_of(source.positions));
}

DeviationMeter::~DeviationMeter() = default;

LevelDeviations DeviationMeter::of_source() const {
  const Tallies none(extents_.size());
  return larger_of(none, none, extents_, extent_, false);
}

LevelDeviations DeviationMeter::of(const ChartedSurface& level, const FramedSurface& framed,
                                   const BakedMap* map) const {
  const bool has_normals = normals_ != nullptr && map != nullptr;
  const RayScene level_scene = scene_of(level);
  struct Found {
    double distance = 0;
    double angle = 0;
  };
  std::vector<Found> found(places_.size());
  const auto look = [&](std::size_t i, const NearestPoint& near) {
    if (!near.exists()) return;
    found[i].distance = near.distance;
    if (!has_normals) return;
    const Vec3d seen = normals_->shown_by(*map, level, framed, near.triangle, near.weights);
    found[i].angle = std::atan2(seen.cross(places_[i].normal).length(), seen.dot(places_[i].normal));
  };
  for_each_nearest(
      level_scene, found.size(), [&](std::size_t i) { return places_[i].position; }, look);
  Tallies there(extents_.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    there.add(places_[i].body, found[i].distance);
    there.add_angle(places_[i].body, found[i].angle);
  }
  const std::vector<SurfacePoint> points = spread(level);
  std::vector<double> distances(points.size());
  for_each_nearest(
      scene_, points.size(),
      [&](std::size_t i) { return position_on(level, level.triangles[points[i].triangle], points[i].weights); },
      [&](std::size_t i, const NearestPoint& near) { distances[i] = near.distance; });
  Tallies back(extents_.size());
  const auto body_of = [&](const ChartedTriangle& t) {
    return static_cast<std::size_t>(bodies_.owner_of(t.patch) + 1);
  };
  for (std::size_t i = 0; i < points.size(); ++i) back.add(body_of(level.triangles[points[i].triangle]), distances[i]);
  std::vector<double> at_vertices(level.positions.size());
  for_each_nearest(
      scene_, at_vertices.size(), [&](std::size_t v) { return Vec3d(level.positions[v]); },
      [&](std::size_t v, const NearestPoint& near) { at_vertices[v] = near.distance; });
  for (const ChartedTriangle& t : level.triangles) {
    for (const ChartedCorner& c : t.corners) back.add_largest(body_of(t), at_vertices[c.vertex]);
  }
  return larger_of(there, back, extents_, extent_, has_normals);
}

}  // namespace lozenge
