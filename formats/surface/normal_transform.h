// How normals and offsets move with a surface.
#pragma once

#include <Imath/ImathMatrix.h>

#include <array>

#include "formats/base/vector.h"

namespace lozenge {

/// The matrix that takes normals along: the cofactors of the linear part, which are its inverse transpose times its
/// determinant, and exist where the inverse doesn't.
struct NormalTransform {
  std::array<Vec3d, 3> rows;
  std::array<Vec3d, 3> axes;  ///< where the linear part itself takes them
  bool is_identity = false;
  bool mirrored = false;

  /// \param m  for row vectors
  explicit NormalTransform(const Imath::M44d& m);

  /// Unit, or zero where `n` is.
  Vec3f operator()(const Vec3f& n) const;
  /// A difference of two places.
  Vec3f offset(const Vec3f& d) const;
};

}  // namespace lozenge
