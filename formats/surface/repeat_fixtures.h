// Repeated meshes of no particular surface: for tests of whatever carries them along.
#pragma once

#include <gtest/gtest.h>

#include <Imath/ImathMatrix.h>

#include <cmath>
#include <random>
#include <string>

#include "formats/surface/repeats.h"

namespace lozenge::fixtures {

/// Turned, scaled and moved at random; every other one mirrors.
inline Placement random_placement(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-3, 3);
  Imath::M44d m;
  m.rotate(Imath::V3d(number(random), number(random), number(random)));
  Placement placement = kUnmoved;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = 0.1 + std::abs(number(random));
    const double scale = axis == 0 && random() % 2 == 0 ? -size : size;
    for (int c = 0; c < 3; ++c) placement[4 * axis + c] = scale * m[axis][c];
    placement[12 + axis] = 10 * number(random);
  }
  return placement;
}

/// One to three meshes of one to three copies, and owners from among them, or none. \param count  of owners
inline Repeats random_repeats(std::size_t count, std::mt19937& random) {
  Repeats repeats;
  const unsigned meshes = 1 + random() % 3;
  for (unsigned m = 0; m < meshes; ++m) {
    repeats.meshes.push_back({m == 1 ? "" : "m\xC3\xA4sh \"" + std::to_string(m) + "\"", {}});
    for (unsigned c = 0; c < 1 + random() % 3; ++c) repeats.meshes.back().copies.push_back(random_placement(random));
  }
  for (std::size_t i = 0; i < count; ++i) {
    repeats.owner.push_back(static_cast<std::int32_t>(random() % (meshes + 1)) - 1);
  }
  return repeats;
}

inline void expect_same(const Repeats& a, const Repeats& b) {
  EXPECT_EQ(a.owner, b.owner);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    EXPECT_EQ(a.meshes[m].name, b.meshes[m].name);
    EXPECT_EQ(a.meshes[m].copies, b.meshes[m].copies);
  }
}

}  // namespace lozenge::fixtures
