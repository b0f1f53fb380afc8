// Bodies of higher genus as zero sets: simple solids whose signed distances are melted together, then engraved.

#include <algorithm>
#include <cmath>

#include "test_assets/shape.h"

namespace lozenge::test_assets {
namespace {

/// The smaller of two distances, with a fillet of about `radius` where they meet.
double melted(double a, double b, double radius) {
  const double h = std::max(radius - std::abs(a - b), 0.0) / radius;
  return std::min(a, b) - h * h * radius / 4;
}

/// The first of both without the second, with a rounded rim.
double carved(double a, double b, double radius) { return -melted(-a, b, radius); }

/// Roughly the distance to an ellipsoid: exact on its surface, of the right size nearby.
double ellipsoid(const Vec3d& p, const Vec3d& centre, const Vec3d& radii) {
  const Vec3d q = (p - centre) / radii;
  const double inner = q.length();
  const double slope = (q / radii).length();
  return slope == 0 ? -std::min({radii.x, radii.y, radii.z}) : inner * (inner - 1) / slope;
}

/// A rod from a to b with round ends, whose radius goes from ra to rb.
double rod(const Vec3d& p, const Vec3d& a, const Vec3d& b, double ra, double rb) {
  const Vec3d axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.length2(), 0.0, 1.0);
  return (p - a - axis * t).length() - (ra + (rb - ra) * t);
}

/// A ring in the plane across `axis` (0 = x, 1 = y, 2 = z).
double ring(const Vec3d& p, const Vec3d& centre, int axis, double radius, double tube) {
  const Vec3d q = p - centre;
  const double along = q[axis];
  const double out = std::sqrt(std::max(q.length2() - along * along, 0.0)) - radius;
  return std::sqrt(out * out + along * along) - tube;
}

/// A disc around the y axis with rounded rims.
double disc(const Vec3d& p, double low, double high, double radius, double rim) {
  const double out = std::sqrt(p.x * p.x + p.z * p.z) - radius + rim;
  const double up = std::max(low - p.y, p.y - high) + rim;
  return std::min(std::max(out, up), 0.0) + std::hypot(std::max(out, 0.0), std::max(up, 0.0)) - rim;
}

/// 1 inside [low, high], 0 outside, with smooth flanks of width `flank`.
double window(double value, double low, double high, double flank) {
  const auto rise = [flank](double x) {
    const double t = std::clamp(x / flank + 0.5, 0.0, 1.0);
    return t * t * (3 - 2 * t);
  };
  return rise(value - low) * rise(high - value);
}

double three_rings(const Vec3d& p) {
  const double left = ring(p, Vec3d(-1.4, 0, 0), 2, 0.75, 0.28);
  const double middle = ring(p, Vec3d(0, 0, 0), 2, 0.75, 0.28);
  const double right = ring(p, Vec3d(1.4, 0, 0), 2, 0.75, 0.28);
  return melted(melted(left, middle, 0.2), right, 0.2);
}

/// The idol without its relief: y is up, it looks along z.
double idol(const Vec3d& p) {
  const Vec3d mirrored(std::abs(p.x), p.y, p.z);
  const double plinth = disc(p, 0, 0.1, 0.46, 0.03);
  const double skirt = melted(rod(p, Vec3d(0, 0.12, 0), Vec3d(0, 0.75, 0), 0.36, 0.22),
                              ellipsoid(p, Vec3d(0, 0.55, 0.02), Vec3d(0.33, 0.3, 0.29)), 0.1);
  const double chest = melted(ellipsoid(p, Vec3d(0, 1.0, 0), Vec3d(0.3, 0.26, 0.2)),
                              rod(p, Vec3d(0, 0.7, 0), Vec3d(0, 1.0, 0), 0.17, 0.18), 0.1);
  const double head = melted(ellipsoid(p, Vec3d(0, 1.52, 0.02), Vec3d(0.2, 0.23, 0.21)),
                             rod(p, Vec3d(0, 1.15, 0), Vec3d(0, 1.4, 0), 0.11, 0.1), 0.06);
  const double arm = melted(rod(mirrored, Vec3d(0.27, 1.12, 0), Vec3d(0.6, 0.86, -0.03), 0.095, 0.075),
                            rod(mirrored, Vec3d(0.6, 0.86, -0.03), Vec3d(0.3, 0.62, 0.1), 0.075, 0.07), 0.04);
  const double crown = ring(p, Vec3d(0, 1.87, 0), 2, 0.16, 0.05);
  double body = melted(melted(skirt, chest, 0.08), head, 0.05);
  body = melted(melted(body, arm, 0.06), crown, 0.05);
  body = melted(body, plinth, 0.04);
  return -melted(-body, p.y - 0.01, 0.02);  // stands on a plane
}

/// Face: brow and nose stand out, the eyes are sunk, the mouth is a slit.
double with_face(const Vec3d& p, double body) {
  const Vec3d mirrored(std::abs(p.x), p.y, p.z);
  const double nose = rod(p, Vec3d(0, 1.58, 0.21), Vec3d(0, 1.47, 0.25), 0.018, 0.032);
  const double brow = rod(mirrored, Vec3d(0.02, 1.59, 0.215), Vec3d(0.13, 1.585, 0.165), 0.018, 0.014);
  const double eye = ellipsoid(mirrored, Vec3d(0.075, 1.535, 0.21), Vec3d(0.04, 0.022, 0.035));
  const double mouth = rod(mirrored, Vec3d(0, 1.415, 0.215), Vec3d(0.06, 1.422, 0.2), 0.014, 0.008);
  const double pupil = ellipsoid(mirrored, Vec3d(0.075, 1.535, 0.19), Vec3d(0.022, 0.018, 0.02));
  double face = melted(melted(body, nose, 0.03), brow, 0.02);
  face = carved(carved(face, eye, 0.015), mouth, 0.012);
  return melted(face, pupil, 0.006);
}

/// How far the relief stands out of the body at p.
double relief(const Vec3d& p) {
  const double turn = std::atan2(p.x, p.z);
  const double out = std::hypot(p.x, p.z);
  const double flutes = std::cos(22 * turn) * window(p.y, 0.18, 0.5, 0.06);
  const double hem = std::cos(44 * turn) * window(p.y, 0.12, 0.17, 0.02);
  const double waist = window(out, 0, 0.34, 0.02);
  const double belt = (window(p.y, 0.535, 0.57, 0.015) + window(p.y, 0.67, 0.7, 0.015)) * waist;
  const double stitches = std::cos(40 * turn) * window(p.y, 0.585, 0.655, 0.02) * waist;
  const double torso = window(p.y, 0.76, 1.2, 0.05) * window(out, 0, 0.29, 0.03);
  const double lozenges = std::max(0.0, std::cos(14 * turn) * std::cos(40 * p.y) + 0.2 * std::cos(28 * turn)) * torso;
  const double back = window(-p.z, -0.03, 1, 0.1) + window(p.y, 1.62, 2, 0.06);
  const double curls = std::cos(16 * turn + 60 * p.y) * window(p.y, 1.36, 1.74, 0.05) * std::min(back, 1.0);
  const double bands = window(std::abs(p.x), 0.4, 0.43, 0.012) * window(p.y, 0.5, 1.2, 0.02);
  return 0.013 * flutes + 0.006 * hem + 0.014 * belt + 0.006 * stitches + 0.02 * lozenges + 0.009 * curls +
         0.012 * bands;
}

/// The crown's own relief: a cord around its tube.
double cord(const Vec3d& p) {
  const Vec3d q = p - Vec3d(0, 1.87, 0);
  const double around = std::atan2(q.x, q.y);
  const double section = std::atan2(q.z, std::hypot(q.x, q.y) - 0.16);
  return 0.008 * std::cos(18 * around + 3 * section) * window(q.y, -0.1, 1, 0.08);
}

}  // namespace

Shape genus3() { return implicit_surface(three_rings, Vec3d(-2.6, -1.2, -0.5), Vec3d(2.6, 1.2, 0.5), 0.102, 8); }

Shape statue() {
  const auto field = [](const Vec3d& p) { return with_face(p, idol(p)) - relief(p) - cord(p); };
  return implicit_surface(field, Vec3d(-0.8, -0.1, -0.6), Vec3d(0.8, 2.2, 0.6), 0.019, 8);
}

}  // namespace lozenge::test_assets
