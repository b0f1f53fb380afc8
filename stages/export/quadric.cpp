#include "stages/export/quadric.h"

#include <algorithm>

namespace lozenge {

void Quadric::add_plane(const Vec3d& normal, const Vec3d& point, double weight) {
  const double d = -normal.dot(point);
  xx += weight * normal.x * normal.x;
  xy += weight * normal.x * normal.y;
  xz += weight * normal.x * normal.z;
  yy += weight * normal.y * normal.y;
  yz += weight * normal.y * normal.z;
  zz += weight * normal.z * normal.z;
  b += normal * (weight * d);
  c += weight * d * d;
}

void Quadric::add_point(const Vec3d& point, double weight) {
  xx += weight;
  yy += weight;
  zz += weight;
  b -= point * weight;
  c += weight * point.length2();
}

Quadric& Quadric::operator+=(const Quadric& other) {
  xx += other.xx;
  xy += other.xy;
  xz += other.xz;
  yy += other.yy;
  yz += other.yz;
  zz += other.zz;
  b += other.b;
  c += other.c;
  return *this;
}

double Quadric::at(const Vec3d& x) const {
  const Vec3d ax(xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z, xz * x.x + yz * x.y + zz * x.z);
  return std::max(0.0, x.dot(ax) + 2 * b.dot(x) + c);
}

Vec3d Quadric::least() const {
  // Cramer's rule on A x = -b.
  const Vec3d row_x(xx, xy, xz);
  const Vec3d row_y(xy, yy, yz);
  const Vec3d row_z(xz, yz, zz);
  const Vec3d yz_cross = row_y.cross(row_z);
  const double determinant = row_x.dot(yz_cross);
  return (yz_cross * -b.x + row_z.cross(row_x) * -b.y + row_x.cross(row_y) * -b.z) / determinant;
}

}  // namespace lozenge
