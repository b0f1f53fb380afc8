// Every point writes its distance into its own slot; sums run over the slots in their order afterwards, so that the
// number of threads changes no bit.
#include "stages/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/surface/boundary.h"
#include "formats/surface/nearest_in_row.h"
#include "formats/surface/ray_scene.h"
#include "formats/surface/spread_points.h"

namespace lozenge {

namespace {

/// Points that a thread asks about in a row.
constexpr std::size_t kBatch = 256;

RayScene make_scene(const SurfaceView& surface) {
  return RayScene(std::vector<Vec3f>(surface.positions.begin(), surface.positions.end()),
                  std::vector<std::array<VertexId, 3>>(surface.triangles.begin(), surface.triangles.end()));
}

/// [point] value(point, what of a surface is nearest to position(point)), in parallel.
template <typename Position, typename Value>
std::vector<double> map_nearest(const RayScene& scene, std::size_t count, const Position& position, const Value& value,
                                const std::string& what, const Progress& progress) {
  std::vector<double> values(count);
  for_each_index((count + kBatch - 1) / kBatch, progress, what, [&](std::size_t batch) {
    const std::size_t end = std::min(count, (batch + 1) * kBatch);
    visit_nearest_in_row(scene, batch * kBatch, end, position,
                         [&](std::size_t i, const NearestPoint& near) { values[i] = value(i, near); });
  });
  return values;
}

/// [point] how far it is from a surface.
template <typename Position>
std::vector<double> distances_to(const RayScene& scene, std::size_t count, const Position& position,
                                 const std::string& what, const Progress& progress) {
  return map_nearest(
      scene, count, position, [](std::size_t, const NearestPoint& near) { return near.distance; }, what, progress);
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double max_of(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

std::vector<SurfacePoint> points_of(const SurfaceView& surface, std::int64_t count, const char* name) {
  std::vector<SurfacePoint> points = spread_points(surface, count);
  if (points.empty()) {
    throw Error(ExitCode::kUnusableInput,
                fmt::format("surface {} has no triangle of positive area; there is nothing to measure from", name));
  }
  return points;
}

/// Vertices that some triangle uses: a loose one is no part of the surface.
std::vector<VertexId> used_vertices(const SurfaceView& surface) {
  std::vector<bool> used(surface.positions.size(), false);
  for (const auto& t : surface.triangles) {
    for (const VertexId v : t) used[v] = true;
  }
  std::vector<VertexId> vertices;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) vertices.push_back(static_cast<VertexId>(v));
  }
  return vertices;
}

OneWayDistance one_way(const SurfaceView& from, const RayScene& to, std::int64_t count, double box_diagonal,
                       const char* name, const Progress& progress) {
  const std::vector<SurfacePoint> points = points_of(from, count, name);
  const std::string what = fmt::format("distances from {}", name);
  const std::vector<double> distances = distances_to(
      to, points.size(), [&](std::size_t i) { return position_of(from, points[i]); }, what, progress);
  const std::vector<VertexId> vertices = used_vertices(from);
  const std::vector<double> corners = distances_to(
      to, vertices.size(), [&](std::size_t i) { return Vec3d(from.positions[vertices[i]]); }, what, progress);
  OneWayDistance result;
  result.mean = mean_of(distances);
  result.max = std::max(max_of(distances), max_of(corners));
  result.mean_percent = 100 * result.mean / box_diagonal;
  result.max_percent = 100 * result.max / box_diagonal;
  return result;
}

/// A boundary as triangles without area, which a nearest point doesn't mind.
RayScene make_boundary_scene(const SurfaceView& surface, const std::vector<BoundarySide>& sides) {
  std::vector<std::array<VertexId, 3>> lines;
  for (const auto& [from, to] : sides) lines.push_back({from, to, to});
  return RayScene(std::vector<Vec3f>(surface.positions.begin(), surface.positions.end()), lines);
}

/// Points along the boundary, `count` of them evenly by length and all vertices.
std::vector<Vec3d> points_along(const SurfaceView& surface, const std::vector<BoundarySide>& sides,
                                std::int64_t count) {
  double length = 0;
  for (const auto& [from, to] : sides) {
    length += (Vec3d(surface.positions[to]) - Vec3d(surface.positions[from])).length();
  }
  std::vector<Vec3d> points;
  for (const auto& [from, to] : sides) {
    const Vec3d start(surface.positions[from]);
    const Vec3d along = Vec3d(surface.positions[to]) - start;
    const double share = length > 0 ? along.length() / length : 0;
    const auto steps = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(count))) + 1;
    for (std::int64_t k = 0; k < steps; ++k) {
      points.push_back(start + along * (static_cast<double>(k) / static_cast<double>(steps)));
    }
  }
  return points;
}

double farthest(const std::vector<Vec3d>& points, const RayScene& to, const Progress& progress) {
  return max_of(distances_to(
      to, points.size(), [&](std::size_t i) { return points[i]; }, "boundaries", progress));
}

void compare_boundaries(const SurfaceView& a, const SurfaceView& b, const CompareOptions& options, Comparison& result,
                        const Progress& progress) {
  const std::vector<BoundarySide> sides_a = boundary_sides(a.triangles);
  const std::vector<BoundarySide> sides_b = boundary_sides(b.triangles);
  result.boundary_loops_a = static_cast<std::int64_t>(boundary_loops(sides_a).size());
  result.boundary_loops_b = static_cast<std::int64_t>(boundary_loops(sides_b).size());
  if (!result.both_end()) return;
  result.boundary_a_to_b =
      farthest(points_along(a, sides_a, options.points), make_boundary_scene(b, sides_b), progress);
  result.boundary_b_to_a =
      farthest(points_along(b, sides_b, options.points), make_boundary_scene(a, sides_a), progress);
}

double box_diagonal_of(const SurfaceView& surface) {
  Bounds box;
  bool first = true;
  for (const VertexId v : used_vertices(surface)) {
    const Vec3f& p = surface.positions[v];
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = first ? p[axis] : std::min(box.low[axis], p[axis]);
      box.high[axis] = first ? p[axis] : std::max(box.high[axis], p[axis]);
    }
    first = false;
  }
  return diagonal(box);
}

nlohmann::ordered_json json_of(const OneWayDistance& d) {
  return {{"mean", d.mean}, {"max", d.max}, {"mean_percent", d.mean_percent}, {"max_percent", d.max_percent}};
}

std::string line_of(const char* what, const OneWayDistance& d) {
  return fmt::format("{}  mean {:.6g} ({:.4f} %)  max {:.6g} ({:.4f} %)", what, d.mean, d.mean_percent, d.max,
                     d.max_percent);
}

}  // namespace

Comparison compare(const SurfaceView& a, const SurfaceView& b, const CompareOptions& options,
                   const Progress& progress) {
  if (options.points <= 0) {
    throw Error(ExitCode::kUsage, fmt::format("{} points cannot measure a distance; give 1 or more", options.points));
  }
  Comparison result;
  result.diagonal = box_diagonal_of(a);
  // Refused before the scenes are built: they would be built for nothing.
  points_of(a, 1, "A");
  points_of(b, 1, "B");
  const RayScene scene_a = make_scene(a);
  const RayScene scene_b = make_scene(b);
  result.a_to_b = one_way(a, scene_b, options.points, result.diagonal, "A", progress);
  result.b_to_a = one_way(b, scene_a, options.points, result.diagonal, "B", progress);
  compare_boundaries(a, b, options, result, progress);
  return result;
}

NormalComparison compare_normals(const Asset& asset, std::int32_t level, const SourceMesh& source,
                                 const CompareOptions& options, const Progress& progress) {
  if (level < 0 || level >= static_cast<std::int32_t>(asset.levels.size())) {
    throw Error(ExitCode::kUsage, fmt::format("the asset has no level of detail {}; it has 0 to {}", level,
                                              static_cast<int>(asset.levels.size()) - 1));
  }
  const AssetLevel& geometry = asset.levels[level];
  if (geometry.normals.empty()) {
    throw Error(ExitCode::kUnusableInput, "the asset has no normals to compare; export it with normals");
  }
  const std::vector<SurfacePoint> points = points_of(geometry.view(), options.points, "of the asset");
  points_of({source.positions, source.triangles}, 1, "of the source");
  const RayScene scene(source.positions, source.triangles);
  const ShadingNormals shading(source);
  std::vector<double> angles = map_nearest(
      scene, points.size(), [&](std::size_t i) { return position_of(geometry.view(), points[i]); },
      [&](std::size_t i, const NearestPoint& near) {
        const Vec3d theirs(shading.at(near.triangle, near.weights));
        const Vec3d ours(mapped_normal(asset, geometry, points[i].triangle, points[i].weights));
        return std::atan2(ours.cross(theirs).length(), ours.dot(theirs));
      },
      "normals", progress);
  NormalComparison result;
  result.points = static_cast<std::int64_t>(angles.size());
  result.mean = mean_of(angles);
  std::sort(angles.begin(), angles.end());
  result.percentile_95 = angles[std::min(angles.size() - 1, angles.size() * 95 / 100)];
  result.max = angles.back();
  return result;
}

std::vector<std::string> comparison_lines(const Comparison& comparison) {
  std::vector<std::string> lines{line_of("A to B", comparison.a_to_b), line_of("B to A", comparison.b_to_a),
                                 fmt::format("larger  mean {:.4f} %  max {:.4f} %  of A's box diagonal {:.6g}",
                                             comparison.mean_percent(), comparison.max_percent(), comparison.diagonal)};
  const std::string loops =
      fmt::format("{} and {} boundary loop(s)", comparison.boundary_loops_a, comparison.boundary_loops_b);
  if (comparison.both_end()) {
    lines.push_back(fmt::format("ends    {}, max {:.6g} ({:.4f} %) apart", loops,
                                std::max(comparison.boundary_a_to_b, comparison.boundary_b_to_a),
                                comparison.boundary_max_percent()));
  } else if (comparison.boundary_loops_a + comparison.boundary_loops_b > 0) {
    lines.push_back(fmt::format("ends    {}: one of the surfaces is closed", loops));
  }
  return lines;
}

std::string comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json json{{"diagonal", comparison.diagonal},
                              {"a_to_b", json_of(comparison.a_to_b)},
                              {"b_to_a", json_of(comparison.b_to_a)},
                              {"mean_percent", comparison.mean_percent()},
                              {"max_percent", comparison.max_percent()}};
  if (comparison.boundary_loops_a + comparison.boundary_loops_b > 0) {
    json["boundary_loops"] = {{"a", comparison.boundary_loops_a}, {"b", comparison.boundary_loops_b}};
    json["boundary_max_distance_percent"] =
        comparison.both_end() ? nlohmann::ordered_json(comparison.boundary_max_percent()) : nullptr;
  }
  return json.dump(2);
}

}  // namespace lozenge
