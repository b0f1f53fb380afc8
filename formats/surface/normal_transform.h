// How normals move with a surface.
#pragma once

#include <Imath/ImathMatrix.h>

#include <array>

#include "formats/base/vector.h"

namespace lozenge {

/// The matrix that takes normals along: the cofactors of the linear part, which are its inverse transpose times its
/// determinant, and exist where the inverse doesn't.
struct NormalTransform {
  std::array<Vec3d, 3> rows;
  bool is_identity = false;
  bool mirrored = false;

  /// \param m  for row vectors
  explicit NormalTransform(const Imath::M44d& m);

  /// Unit, or zero where `n` is.
  Vec3f operator()(const Vec3f& n) const;
};

}  // namespace lozenge
