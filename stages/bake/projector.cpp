// The cage of rays that leave the level of detail along its interpolated normal is as long as most distances to the
// corresponding point are, and no longer.
#include "stages/bake/projector.h"

#include <algorithm>
#include <cmath>

#include "formats/base/error.h"
#include "formats/base/parallel.h"
#include "formats/patches/patch_place.h"

namespace lozenge {

namespace {

/// Rays start this share of the bounding box's diagonal before the surface that they come from, so that a source
/// surface in the very same place is met. Embree's rounding is below a tenth of it.
constexpr double kTinyShare = 1e-6;

/// Points on each patch that the cage is measured on: an additive sequence that covers the square evenly (its steps are
/// the inverse powers of the plastic number) and never meets the samples of a level of detail, where the distance is 0.
constexpr std::int32_t kCagePoints = 64;
constexpr double kCageStepU = 0.75487766624669276;
constexpr double kCageStepV = 0.56984029099805327;
constexpr double kCagePercentile = 0.99;
constexpr double kCageMargin = 2;

}  // namespace

Projector::Projector(const SourceMesh& mesh, const Parameterization& map, const GeometryImage& image)
    : mesh_(mesh),
      image_(image),
      scene_(mesh.positions, mesh.triangles),
      images_(mesh, map),
      tiny_(diagonal(bounds_of(mesh.positions)) * kTinyShare) {
  locators_.reserve(map.domain.triangles.size());
  for (DomainTriangleId t = 0; t < map.domain.size(); ++t) locators_.emplace_back(images_, t);
}

SourcePoint Projector::correspondence(std::int32_t patch, double u, double v) const {
  const DomainPoint p = domain_point_at(image_.layout.places[patch], u, v);
  if (const auto found = locators_[p.triangle].find(lattice_point(p))) return *found;
  refuse_hole(p.triangle);
}

LocatedPoint Projector::locate(std::int32_t patch, double u, double v) const {
  const PatchPlace& place = image_.layout.places[patch];
  const DomainPoint p = domain_point_at(place, u, v);
  const auto found = locators_[p.triangle].locate(lattice_point(p));
  if (!found) refuse_hole(p.triangle);
  // The lattice's u is beta, its v is 1 - alpha - beta.
  const auto weights_along = [&](const Vec2d& step) {
    return found->along_u * step.y - found->along_v * (step.x + step.y);
  };
  const PlaceSteps steps = steps_at(place, u, v);
  return {found->point, weights_along(steps.along_u), weights_along(steps.along_v)};
}

void Projector::refuse_hole(DomainTriangleId triangle) const {
  throw Error(ExitCode::kUnusableInput, mesh_.origin + ": the map leaves a place of domain triangle " +
                                            std::to_string(triangle) + " uncovered; parameterize the mesh again");
}

double Projector::measured_cage(const TargetSurface& target) const {
  std::vector<double> distances(static_cast<std::size_t>(image_.size()) * kCagePoints, -1);
  for_each_index(image_.size(), true, [&](std::size_t n) {
    const auto patch = static_cast<std::int32_t>(n);
    for (std::int32_t k = 0; k < kCagePoints; ++k) {
      const double u = std::fmod((k + 1) * kCageStepU, 1.0);
      const double v = std::fmod((k + 1) * kCageStepV, 1.0);
      if (u > v && !image_.layout.places[patch].right.exists()) continue;
      const Vec3d source(position_at(mesh_, correspondence(patch, u, v)));
      distances[n * kCagePoints + k] = (target.at(patch, u, v).position - source).length();
    }
  });
  std::erase_if(distances, [](double d) { return d < 0; });
  if (distances.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(kCagePercentile * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
  return kCageMargin * distances[static_cast<std::size_t>(rank)];
}

Vec3d Projector::face_normal(TriangleId t) const {
  const auto& [a, b, c] = mesh_.triangles[t];
  const Vec3d p(mesh_.positions[a]);
  return (Vec3d(mesh_.positions[b]) - p).cross(Vec3d(mesh_.positions[c]) - p).normalized();
}

}  // namespace lozenge
