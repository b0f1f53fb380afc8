#include "pipeline/quality/colour_difference.h"

#include <cmath>
#include <numbers>

namespace lozenge {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

double cosine(double degrees) { return std::cos(degrees * kDegree); }

/// The cube root, made straight near 0 (CIE 15).
double lightness(double share) {
  constexpr double kBend = 216.0 / 24389;
  constexpr double kSlope = 24389.0 / 27;
  return share > kBend ? std::cbrt(share) : (kSlope * share + 16) / 116;
}

/// Degrees from 0 to 360; 0 of grey.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double angle = std::atan2(b, a) / kDegree;
  return angle < 0 ? angle + 360 : angle;
}

/// x^7 / (x^7 + 25^7), which tells strong colours from weak ones.
double strength(double chroma) {
  const double power = std::pow(chroma, 7);
  return std::sqrt(power / (power + std::pow(25.0, 7)));
}

/// The shorter way round from one hue to another, in degrees (eq. 10).
double hue_step(double from, double to) {
  const double step = to - from;
  return step > 180 ? step - 360 : step < -180 ? step + 360 : step;
}

/// The hue in the middle of that way (eq. 14).
double mean_hue(double first, double second) {
  const double sum = first + second;
  if (std::abs(first - second) <= 180) return sum / 2;
  return sum < 360 ? (sum + 360) / 2 : (sum - 360) / 2;
}

}  // namespace

Vec3d lab_of_linear(const Vec3d& c) {
  // IEC 61966-2-1, divided by the white point.
  const double x = (0.4124564 * c.x + 0.3575761 * c.y + 0.1804375 * c.z) / 0.95047;
  const double y = 0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z;
  const double z = (0.0193339 * c.x + 0.1191920 * c.y + 0.9503041 * c.z) / 1.08883;
  return {116 * lightness(y) - 16, 500 * (lightness(x) - lightness(y)), 200 * (lightness(y) - lightness(z))};
}

double ciede2000(const Vec3d& first, const Vec3d& second) {
  const double g = 0.5 * (1 - strength((std::hypot(first.y, first.z) + std::hypot(second.y, second.z)) / 2));
  const double a1 = (1 + g) * first.y;
  const double a2 = (1 + g) * second.y;
  const double c1 = std::hypot(a1, first.z);
  const double c2 = std::hypot(a2, second.z);
  const double h1 = hue(a1, first.z);
  const double h2 = hue(a2, second.z);
  const bool grey = c1 * c2 == 0;
  const double lightness_step = second.x - first.x;
  const double chroma_step = c2 - c1;
  const double turn = grey ? 0 : 2 * std::sqrt(c1 * c2) * std::sin(hue_step(h1, h2) / 2 * kDegree);

  const double l = (first.x + second.x) / 2;
  const double c = (c1 + c2) / 2;
  const double h = grey ? h1 + h2 : mean_hue(h1, h2);
  const double t =
      1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) - 0.20 * cosine(4 * h - 63);
  const double rotation = -std::sin(60 * std::exp(-std::pow((h - 275) / 25, 2)) * kDegree) * 2 * strength(c);
  const double of_lightness = lightness_step / (1 + 0.015 * std::pow(l - 50, 2) / std::sqrt(20 + std::pow(l - 50, 2)));
  const double of_chroma = chroma_step / (1 + 0.045 * c);
  const double of_hue = turn / (1 + 0.015 * c * t);
  return std::sqrt(of_lightness * of_lightness + of_chroma * of_chroma + of_hue * of_hue +
                   rotation * of_chroma * of_hue);
}

}  // namespace lozenge
