// Each ray of a triangle starts at a point of its own, in a direction of its own.
#include "stages/export/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "formats/base/parallel.h"
#include "formats/surface/source_mesh.h"

namespace lozenge {
namespace {

/// Rays on each side of a triangle: enough to tell what is hidden from what is seen.
constexpr int kRays = 32;
/// What is seen from nowhere counts as if it saw this share.
constexpr float kLeast = 0.1F;
/// Rays start this far before their triangle, by the diagonal of the surface.
constexpr double kStart = 1e-5;

/// A point of a triangle, and a direction from it into the half of space above it, whose density is the cosine's.
struct Probe {
  Vec3d weights;
  Vec3d direction;  ///< z is along the normal
};

/// Spread evenly in all of their dimensions: a rank-1 lattice by powers of the plastic number's four-dimensional kin.
std::vector<Probe> make_probes() {
  constexpr double kRoot = 1.1673039782614187;  // of x^5 = x + 1
  std::vector<Probe> probes;
  for (int i = 0; i < kRays; ++i) {
    std::array<double, 4> u{};
    double step = 1;
    for (double& x : u) {
      step /= kRoot;
      x = std::fmod(0.5 + (i + 1) * step, 1.0);
    }
    if (u[0] + u[1] > 1) {
      u[0] = 1 - u[0];
      u[1] = 1 - u[1];
    }
    const double out = std::sqrt(u[2]);
    const double turn = 2 * std::numbers::pi * u[3];
    probes.push_back(
        {Vec3d(1 - u[0] - u[1], u[0], u[1]), Vec3d(out * std::cos(turn), out * std::sin(turn), std::sqrt(1 - u[2]))});
  }
  return probes;
}

}  // namespace

std::vector<float> exposure_of(const ChartedSurface& surface, const RayScene& scene) {
  const std::vector<Probe> probes = make_probes();
  const double start = kStart * diagonal(bounds_of(surface.positions));
  std::vector<float> exposure(surface.triangles.size(), kLeast);
  for_each_part(exposure.size(), [&](std::size_t begin, std::size_t end) {
    std::array<Ray, kRays> rays;
    std::array<std::uint8_t, kRays> blocked{};
    for (std::size_t t = begin; t < end; ++t) {
      std::array<Vec3d, 3> p;
      for (int k = 0; k < 3; ++k) p[k] = Vec3d(surface.positions[surface.triangles[t].corners[k].vertex]);
      const Vec3d along = (p[1] - p[0]).normalized();
      const Vec3d normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      if (!(normal.length2() > 0.5)) continue;
      const Vec3d across = normal.cross(along);
      for (const double side : {1.0, -1.0}) {
        for (std::size_t i = 0; i < probes.size(); ++i) {
          const auto& [w, d] = probes[i];
          rays[i].origin = p[0] * w.x + p[1] * w.y + p[2] * w.z + normal * (side * start);
          rays[i].direction = along * d.x + across * d.y + normal * (side * d.z);
        }
        const std::int32_t hidden = scene.occluded(rays, blocked);
        const float seen = 1 - static_cast<float>(hidden) / kRays;
        exposure[t] = std::max(exposure[t], kLeast + (1 - kLeast) * seen);
        if (2 * hidden < kRays) break;  // the other side can't matter more than this one
      }
    }
  });
  return exposure;
}

}  // namespace lozenge
