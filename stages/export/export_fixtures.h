// Geometry images made by hand for the tests of export: spheres (or parts of one) over any domain, without the stages
// before.
#pragma once

#include <cmath>
#include <vector>

#include "formats/domain/domain.h"
#include "formats/patches/baked_maps.h"
#include "formats/patches/geometry_image.h"
#include "formats/patches/patch_place.h"

namespace lozenge::export_fixtures {

/// The point of the unit sphere over a domain point: corners by `places`, in between the normalized mean. The weights
/// are rounded to 2^-20, so that the same point gives the same bits whichever way it was computed.
inline Vec3f on_sphere(const Domain& domain, const std::vector<Vec3d>& places, const DomainPoint& p) {
  constexpr double kSteps = 1 << 20;
  const double alpha = std::round(p.alpha * kSteps) / kSteps;
  const double beta = std::round(p.beta * kSteps) / kSteps;
  const Vec3d sum = places[domain.corner(p.triangle, 0)] * alpha + places[domain.corner(p.triangle, 1)] * beta +
                    places[domain.corner(p.triangle, 2)] * (1 - alpha - beta);
  return Vec3f(sum.normalized());
}

/// Every second sample of `fine`.
inline GeometryLevel coarser(const GeometryImage& image, const GeometryLevel& fine, std::int32_t number) {
  GeometryLevel level = image.empty_level(number, false);
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    for (std::int32_t j = 0; j < level.samples; ++j) {
      for (std::int32_t i = 0; i < level.samples; ++i) {
        level.positions[image.index(level, patch, i, j)] = fine.positions[image.index(fine, patch, 2 * i, 2 * j)];
        level.normals[image.index(level, patch, i, j)] = fine.normals[image.index(fine, patch, 2 * i, 2 * j)];
      }
    }
  }
  return level;
}

/// \param places   [domain vertex] on the unit sphere
/// \param samples  a side, 2^k + 1
inline GeometryImage sphere(const Domain& domain, const std::vector<Vec3d>& places, std::int32_t samples) {
  GeometryImage image;
  image.layout.samples = samples;
  image.layout.places = patch_places(domain);
  image.layout.adjacency = patch_adjacency(image.layout.places);
  image.columns = static_cast<std::int32_t>(std::ceil(std::sqrt(image.size())));
  image.layout.bounds = {{-1, -1, -1}, {1, 1, 1}};
  image.layout.scene_name = "Ball";
  image.layout.origin = "ball.glb";
  GeometryLevel level = image.empty_level(0, false);
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < samples; ++i) {
        if (!image.layout.places[patch].right.exists() && i > j) continue;
        const double last = samples - 1;
        const Vec3f p = on_sphere(domain, places, domain_point_at(image.layout.places[patch], i / last, j / last));
        level.positions[image.index(level, patch, i, j)] = p;
        level.normals[image.index(level, patch, i, j)] = p;
      }
    }
  }
  image.levels.push_back(std::move(level));
  while (image.levels.back().samples > 2) {
    image.levels.push_back(coarser(image, image.levels.back(), static_cast<std::int32_t>(image.levels.size())));
  }
  return image;
}

/// The octahedron's corners; vertices of its domain below are in this order.
inline std::vector<Vec3d> octahedron_places() {
  return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}

inline std::vector<std::array<DomainVertex, 3>> octahedron_faces() {
  return {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
}

inline GeometryImage octahedron(std::int32_t samples) {
  return sphere(make_domain(octahedron_faces(), 6), octahedron_places(), samples);
}

/// The octahedron without its last face: a surface with a boundary.
inline GeometryImage open_octahedron(std::int32_t samples) {
  auto faces = octahedron_faces();
  faces.pop_back();
  return sphere(make_domain(faces, 6), octahedron_places(), samples);
}

/// The octahedron's sphere, and a tetrahedron's; their positions differ because the tetrahedron is turned.
inline GeometryImage two_spheres(std::int32_t samples) {
  auto faces = octahedron_faces();
  faces.insert(faces.end(), {{6, 7, 8}, {6, 9, 7}, {6, 8, 9}, {7, 9, 8}});
  std::vector<Vec3d> places = octahedron_places();
  for (const Vec3d& corner : {Vec3d(1, 1.25, 1), Vec3d(-1, -1, 1.5), Vec3d(-1.75, 1, -1), Vec3d(1, -1, -1.125)}) {
    places.push_back(corner.normalized());
  }
  // Counter-clockwise from outside, whichever way they were written down.
  for (auto& [a, b, c] : faces) {
    if ((places[b] - places[a]).cross(places[c] - places[a]).dot(places[a]) < 0) std::swap(b, c);
  }
  return sphere(make_domain(faces, 10), places, samples);
}

/// A normal map with waves in it, and an occlusion map of half its resolution.
inline BakedMaps maps(const GeometryImage& image, std::int32_t size, std::int32_t level) {
  BakedMaps baked;
  baked.level = level;
  BakedMap normal;
  normal.kind = MapKind::kTangentNormal;
  normal.layout = make_map_layout(image.layout, size, 2);
  normal.level = level;
  for (std::int32_t y = 0; y < normal.height(); ++y) {
    for (std::int32_t x = 0; x < normal.width(); ++x) {
      const Vec3f n = Vec3f(std::sin(0.5F * float(x)), std::cos(0.3F * float(y)), 3).normalized();
      normal.texels.insert(normal.texels.end(), {n.x, n.y, n.z});
    }
  }
  BakedMap occlusion;
  occlusion.kind = MapKind::kOcclusion;
  occlusion.layout = normal.layout;
  occlusion.channels = 1;
  occlusion.shrink = 2;
  occlusion.level = level;
  for (std::int32_t y = 0; y < occlusion.height(); ++y) {
    for (std::int32_t x = 0; x < occlusion.width(); ++x) occlusion.texels.push_back(float((x + y) % 8) / 7);
  }
  baked.maps = {std::move(normal), std::move(occlusion)};
  return baked;
}

}  // namespace lozenge::export_fixtures
