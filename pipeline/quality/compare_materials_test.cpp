#include "pipeline/quality/compare_materials.h"

#include <gtest/gtest.h>

#include "formats/base/error.h"
#include "pipeline/quality/colour_difference.h"

namespace lozenge {
namespace {

/// A unit square of one material, turned over or not.
SourceMesh square(float z, bool turned, const Vec4d& colour) {
  SourceMesh mesh;
  mesh.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (turned) mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  mesh.materials = {0, 0};
  mesh.material_names = {"paint"};
  mesh.material_looks.resize(1);
  mesh.material_looks[0].base_colour = colour;
  return mesh;
}

/// Both in one mesh.
SourceMesh joined(SourceMesh a, const SourceMesh& b) {
  const auto first = static_cast<VertexId>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  a.materials.insert(a.materials.end(), b.triangles.size(), 1);
  a.material_names.push_back("other");
  a.material_looks.push_back(b.material_looks[0]);
  return a;
}

TEST(CompareMaterials, ASurfaceLooksLikeItself) {
  const SourceMesh mesh = square(0, false, {0.2, 0.4, 0.6, 1});
  const MaterialComparison same = compare_materials({&mesh}, {&mesh}, 100);
  EXPECT_EQ(same.points, 100);
  for (const ValueDifference* d :
       {&same.base_colour, &same.alpha, &same.occlusion, &same.roughness, &same.metal, &same.emissive}) {
    EXPECT_EQ(d->max, 0);
  }
}

TEST(CompareMaterials, EachDifferenceIsToldInItsOwnUnit) {
  const SourceMesh a = square(0, false, {0.2, 0.4, 0.6, 1});
  SourceMesh b = square(0, false, {0.3, 0.4, 0.6, 1});
  b.material_looks[0].roughness = 0.75;
  b.material_looks[0].metallic = 0.5;
  b.material_looks[0].emissive = {0, 0.25, 0.125};
  const MaterialComparison found = compare_materials({&a}, {&b}, 100);
  const double difference = ciede2000(lab_of_linear({0.2, 0.4, 0.6}), lab_of_linear({0.3, 0.4, 0.6}));
  EXPECT_NEAR(found.base_colour.mean, difference, 1e-9);
  EXPECT_NEAR(found.base_colour.percentile_95, difference, 1e-9);
  EXPECT_NEAR(found.roughness.mean, 0.25, 1e-12);
  EXPECT_NEAR(found.metal.max, 0.5, 1e-12);
  EXPECT_NEAR(found.emissive.mean, 0.25, 1e-12) << "of the colour that differs most";
}

TEST(CompareMaterials, TheTwoSidesOfAThinSheetArentTakenForEachOther) {
  const SourceMesh both = joined(square(0, false, {1, 0, 0, 1}), square(0.0001F, true, {0, 0, 1, 1}));
  const SourceMesh swapped = joined(square(0.0001F, false, {1, 0, 0, 1}), square(0, true, {0, 0, 1, 1}));
  EXPECT_EQ(compare_materials({&both}, {&swapped}, 100).base_colour.max, 0);
}

TEST(CompareMaterials, ASurfaceWithoutAreaIsRefused) {
  const SourceMesh mesh = square(0, false, {1, 1, 1, 1});
  SourceMesh empty = mesh;
  for (Vec3f& p : empty.positions) p = {0, 0, 0};
  EXPECT_THROW(compare_materials({&mesh}, {&empty}, 10), Error);
  EXPECT_THROW(compare_materials({&empty}, {&mesh}, 10), Error);
}

}  // namespace
}  // namespace lozenge
