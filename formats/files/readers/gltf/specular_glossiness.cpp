// glTF's model of metal m and base colour c reflects (1 - m) 0.96 c diffuse, and 0.04 (1 - m) + m c specular (glTF 2.0,
// Appendix B); the old one (1 - max s) d and s. Setting both equal and doing away with c gives, for the brightness of d
// and s, 0.04 m^2 + (D + s - 0.08) m + 0.04 - s = 0 with D = (1 - max s) d / 0.96.
#include "formats/files/readers/gltf/specular_glossiness.h"

#include <algorithm>
#include <cmath>

namespace lozenge {

namespace {

constexpr double kDielectric = 0.04;

double brightness(const Vec3d& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

double metal_of(double diffuse, double specular) {
  if (specular <= kDielectric) return 0;
  const double b = diffuse / (1 - kDielectric) + specular - 2 * kDielectric;
  const double c = kDielectric - specular;
  return std::clamp((-b + std::sqrt(std::max(b * b - 4 * kDielectric * c, 0.0))) / (2 * kDielectric), 0.0, 1.0);
}

}  // namespace

MetallicRoughness metallic_roughness_of(const SpecularGlossiness& old) {
  const double left = 1 - std::max({old.specular.x, old.specular.y, old.specular.z});
  const Vec3d diffuse = Vec3d(old.diffuse.x, old.diffuse.y, old.diffuse.z) * left;
  MetallicRoughness found;
  found.metallic = metal_of(brightness(diffuse), brightness(old.specular));
  found.roughness = 1 - std::clamp(old.glossiness, 0.0, 1.0);
  found.base_colour.w = old.diffuse.w;
  const double m = found.metallic;
  // Each of the two tells the colour well where most of it is reflected that way.
  const double share = m * m;
  for (int c = 0; c < 3; ++c) {
    const double by_diffuse = m < 1 ? diffuse[c] / (1 - kDielectric) / (1 - m) : 0;
    const double by_specular = m > 0 ? (old.specular[c] - kDielectric * (1 - m)) / m : 0;
    found.base_colour[c] = std::clamp(by_diffuse * (1 - share) + by_specular * share, 0.0, 1.0);
  }
  return found;
}

}  // namespace lozenge
