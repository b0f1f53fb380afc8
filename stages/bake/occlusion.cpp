// Rays are spread by the cosine, so that their share is the integral; all texels have the same stratified set, each
// XORed with bits of its own (a random digital shift), so that noise has no pattern.
#include "stages/bake/occlusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lozenge {

namespace {

/// The bits of `i` in reverse: the sequence of van der Corput.
std::uint32_t reversed(std::uint32_t i) {
  i = (i << 16) | (i >> 16);
  i = ((i & 0x00ff00ffU) << 8) | ((i >> 8) & 0x00ff00ffU);
  i = ((i & 0x0f0f0f0fU) << 4) | ((i >> 4) & 0x0f0f0f0fU);
  i = ((i & 0x33333333U) << 2) | ((i >> 2) & 0x33333333U);
  return ((i & 0x55555555U) << 1) | ((i >> 1) & 0x55555555U);
}

/// The second coordinate of Sobol's sequence; with `reversed`, a (0, 2)-sequence in base 2.
std::uint32_t sobol(std::uint32_t i) {
  std::uint32_t result = 0;
  for (std::uint32_t direction = 1U << 31; i; i >>= 1, direction ^= direction >> 1) {
    if (i & 1U) result ^= direction;
  }
  return result;
}

/// Well mixed bits of a number (the finalizer of SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

double unit_interval(std::uint32_t bits) { return (bits + 0.5) / 4294967296.0; }

/// The direction around +z whose density is the cosine, for a point of the unit square.
Vec3d cosine_direction(double x, double y) {
  const double radius = std::sqrt(x);
  const double angle = 2 * std::numbers::pi * y;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - x)};
}

}  // namespace

float openness(const RayScene& scene, const OcclusionPoint& point, const OcclusionRays& options, std::uint64_t seed,
               std::int64_t& rays) {
  const Vec3d& n = point.shading_normal;
  const Vec3d right = (std::abs(n.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)).cross(n).normalized();
  const Vec3d up = n.cross(right);
  const Vec3d& face = point.face_normal.length() > 0 ? point.face_normal : n;
  const Vec3d origin = point.position + face * options.nearest;
  const std::uint64_t shift = mixed(seed);
  std::int32_t traced = 0;
  std::int32_t closed = 0;
  std::array<Ray, RayScene::kPacket> packet;
  std::array<std::uint8_t, RayScene::kPacket> blocked{};
  std::size_t filled = 0;
  const auto trace = [&] {
    closed += scene.occluded({packet.data(), filled}, blocked);
    traced += static_cast<std::int32_t>(filled);
    filled = 0;
  };
  for (std::int32_t i = 0; i < options.count; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    const Vec3d d = cosine_direction(unit_interval(reversed(index) ^ static_cast<std::uint32_t>(shift)),
                                     unit_interval(sobol(index) ^ static_cast<std::uint32_t>(shift >> 32)));
    const Vec3d direction = right * d.x + up * d.y + n * d.z;
    if (direction.dot(face) <= 0) continue;
    packet[filled++] = {origin, direction, 0, options.farthest};
    if (filled == packet.size()) trace();
  }
  trace();
  rays += traced;
  return traced > 0 ? static_cast<float>(traced - closed) / static_cast<float>(traced) : 0.0F;
}

}  // namespace lozenge
