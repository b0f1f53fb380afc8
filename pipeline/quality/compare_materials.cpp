#include "pipeline/quality/compare_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/surface/nearest_point.h"
#include "formats/surface/ray_scene.h"
#include "formats/surface/spread_points.h"
#include "pipeline/maps/map_size.h"
#include "pipeline/quality/colour_difference.h"
#include "stages/bake/source_look.h"

namespace lozenge {

namespace {

using Json = nlohmann::ordered_json;

/// One of the surfaces, ready to be looked at.
class Look {
 public:
  explicit Look(const TexturedSurface& surface)
      : mesh_(*surface.mesh), normals_(mesh_), look_(mesh_, normals_, surface.textures) {}

  std::array<Vec3d, 3> corners(TriangleId t) const {
    std::array<Vec3d, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = Vec3d(mesh_.positions[mesh_.triangles[t][c]]);
    return corners;
  }

  Vec3d face_normal(TriangleId t) const {
    const auto [a, b, c] = corners(t);
    return (b - a).cross(c - a).normalized();
  }

  /// A square of the triangle's plane.
  SourceFootprint square(const SourcePoint& at, double side) const {
    if (!(side > 0)) return {at, {}, {}};
    const std::array<Vec3d, 3> triangle = corners(at.triangle);
    const Vec3d along = (triangle[1] - triangle[0]).normalized();
    const Vec3d across = face_normal(at.triangle).cross(along);
    return {at, weights_of_step(triangle, along * side), weights_of_step(triangle, across * side)};
  }

  const SourceLook& look() const { return look_; }
  double emissive_strength() const { return look_.appearance().emissive_strength; }

 private:
  const SourceMesh& mesh_;
  ShadingNormals normals_;
  SourceLook look_;
};

/// The point of `to` that shows what the point of `from` shows.
SourcePoint counterpart(const Look& from, const SourcePoint& at, const Look& to, const RayScene& scene, double reach) {
  const std::array<Vec3d, 3> triangle = from.corners(at.triangle);
  const Vec3d place = point_at(triangle, at.weights);
  const Vec3d normal = from.face_normal(at.triangle);
  const NearestPoint near = scene.nearest(place);
  if (normal.dot(to.face_normal(near.triangle)) >= 0) return {near.triangle, near.weights};
  // The other side of something thin: what faces this way lies near, along the normal.
  constexpr int kMostLayers = 8;
  constexpr double kBeyond = 1e-6;
  double begin = 0;
  for (int i = 0; i < kMostLayers; ++i) {
    const RayHit hit = scene.closest_hit({place + normal * reach, -normal, begin, 2 * reach});
    if (!hit.exists()) break;
    if (hit.front) return {hit.triangle, hit.weights};
    begin = hit.distance + kBeyond * reach;
  }
  return {near.triangle, near.weights};
}

/// What differs at one point, in the order of MaterialComparison.
using Differences = std::array<double, 6>;

double largest(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

Differences differences(const Look& a, const SourceFootprint& at_a, const Look& b, const SourceFootprint& at_b) {
  const Vec4d colour_a = a.look().base_colour(at_a);
  const Vec4d colour_b = b.look().base_colour(at_b);
  const OcclusionRoughnessMetal orm =
      a.look().occlusion_roughness_metal(at_a) - b.look().occlusion_roughness_metal(at_b);
  const Vec3d light = a.look().emissive(at_a) * a.emissive_strength() - b.look().emissive(at_b) * b.emissive_strength();
  const auto lab = [](const Vec4d& c) { return lab_of_linear({c.x, c.y, c.z}); };
  return {ciede2000(lab(colour_a), lab(colour_b)),
          std::abs(colour_a.w - colour_b.w),
          std::abs(orm.x),
          std::abs(orm.y),
          std::abs(orm.z),
          largest(light)};
}

ValueDifference summary(std::vector<std::pair<double, std::size_t>> values, const std::vector<Vec3d>& places) {
  constexpr double kMost = 0.95;
  ValueDifference result;
  for (const auto& [value, point] : values) result.mean += value / static_cast<double>(values.size());
  std::sort(values.begin(), values.end());
  result.percentile_95 = values[static_cast<std::size_t>(kMost * static_cast<double>(values.size() - 1))].first;
  result.max = values.back().first;
  result.worst = places[values.back().second];
  return result;
}

double area_of(const SourceMesh& mesh) {
  double area = 0;
  for (const auto& t : mesh.triangles) area += triangle_area(mesh.positions, t);
  return area;
}

/// What there is to tell of each value.
struct Row {
  std::string_view key;
  std::string_view words;
  ValueDifference MaterialComparison::*value;
};

constexpr std::array kRows{
    Row{"base_colour", "base colour", &MaterialComparison::base_colour},
    Row{"alpha", "alpha", &MaterialComparison::alpha},
    Row{"occlusion", "occlusion", &MaterialComparison::occlusion},
    Row{"roughness", "roughness", &MaterialComparison::roughness},
    Row{"metal", "metal", &MaterialComparison::metal},
    Row{"emissive", "emissive", &MaterialComparison::emissive},
};

}  // namespace

MaterialComparison compare_materials(const TexturedSurface& a, const TexturedSurface& b, std::int64_t points,
                                     const Progress& progress) {
  constexpr double kReach = 0.005;  // of the diagonal
  const SurfaceView surface{a.mesh->positions, a.mesh->triangles};
  const std::vector<SurfacePoint> spread = spread_points(surface, points);
  const double area = area_of(*b.mesh);
  if (spread.empty() || !(area > 0)) {
    throw Error(ExitCode::kUnusableInput, "a surface without area has no look to compare");
  }
  const Look look_a(a);
  const Look look_b(b);
  const RayScene scene(b.mesh->positions, b.mesh->triangles);
  const double texels = texels_of_textures(*b.mesh);
  MaterialComparison result;
  result.points = static_cast<std::int64_t>(spread.size());
  result.footprint = texels > 0 ? std::sqrt(area / texels) : 0;
  const double reach = kReach * diagonal(bounds_of(a.mesh->positions));
  std::vector<Differences> found(spread.size());
  std::vector<Vec3d> places(spread.size());
  report(progress, "comparing materials", 0);
  for_each_part(spread.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SourcePoint at{spread[i].triangle, spread[i].weights};
      places[i] = position_of(surface, spread[i]);
      const SourcePoint other = counterpart(look_a, at, look_b, scene, reach);
      found[i] =
          differences(look_a, look_a.square(at, result.footprint), look_b, look_b.square(other, result.footprint));
    }
  });
  for (std::size_t k = 0; k < kRows.size(); ++k) {
    std::vector<std::pair<double, std::size_t>> values(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) values[i] = {found[i][k], i};
    result.*kRows[k].value = summary(std::move(values), places);
  }
  return result;
}

std::vector<std::string> material_lines(const MaterialComparison& comparison) {
  std::vector<std::string> lines;
  for (const Row& row : kRows) {
    const ValueDifference& d = comparison.*row.value;
    lines.push_back(fmt::format("{:<11} {:.4f} mean, {:.4f} for 95 %, {:.4f} largest, at ({:.5g}, {:.5g}, {:.5g}){}",
                                row.words, d.mean, d.percentile_95, d.max, d.worst.x, d.worst.y, d.worst.z,
                                row.value == &MaterialComparison::base_colour ? ", CIEDE2000" : ""));
  }
  return lines;
}

std::string material_json(const MaterialComparison& comparison) {
  Json json{{"points", comparison.points}, {"footprint", comparison.footprint}};
  for (const Row& row : kRows) {
    const ValueDifference& d = comparison.*row.value;
    json[std::string(row.key)] = {{"mean", d.mean},
                                  {"percentile_95", d.percentile_95},
                                  {"max", d.max},
                                  {"worst", {d.worst.x, d.worst.y, d.worst.z}}};
  }
  return json.dump(2);
}

}  // namespace lozenge
