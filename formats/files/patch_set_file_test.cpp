#include "formats/files/patch_set_file.h"

#include <ImfIntAttribute.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/exr_fixtures.h"
#include "formats/files/geometry_image_file.h"
#include "formats/patches/image_fixtures.h"
#include "formats/surface/body_fixtures.h"

namespace lozenge {
namespace {

using fixtures::ExrPart;

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

std::string refusal(const std::filesystem::path& file) {
  try {
    read_patch_set(file);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUnusableInput) << e.what();
    return e.what();
  }
  return "";
}

TEST(PatchSetFile, GivesBackTheSameBitsThatWereWritten) {
  const fixtures::TestFolder folder;
  std::mt19937 random(3);
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int k : {0, 1, 4}) {
      PatchSet set = fixtures::sphere_patches(base, k);
      set.layout.double_sided = k == 1;
      if (k == 1) {
        set.layout.bodies = fixtures::random_bodies(0, random);
        set.layout.bodies.owner.assign(set.layout.places.size(), 0);
        for (std::size_t s = 0; s < set.positions.size(); ++s) {
          set.influences.insert(set.influences.end(),
                                {static_cast<float>(s), 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
        }
      }
      write_patch_set(folder / "sphere.exr", set);
      const PatchSet back = read_patch_set(folder / "sphere.exr");
      EXPECT_EQ(back.layout.samples, set.layout.samples);
      EXPECT_EQ(back.layout.adjacency, set.layout.adjacency);
      EXPECT_EQ(back.layout.scene_name, set.layout.scene_name);
      EXPECT_EQ(back.layout.origin, set.layout.origin);
      EXPECT_EQ(back.layout.double_sided, set.layout.double_sided);
      fixtures::expect_same(back.layout.bodies, set.layout.bodies);
      EXPECT_EQ(back.influences, set.influences);
      EXPECT_EQ(back.layout.bounds.low, set.layout.bounds.low);
      EXPECT_EQ(back.layout.bounds.high, set.layout.bounds.high);
      EXPECT_TRUE(same_bits(back.positions, set.positions));
      EXPECT_TRUE(same_bits(back.normals, set.normals));
      EXPECT_TRUE(same_bits(back.source_triangles, set.source_triangles));
      EXPECT_TRUE(same_bits(back.source_weights, set.source_weights));
      write_patch_set(folder / "again.exr", back);
      EXPECT_EQ(fixtures::bytes_of(folder / "sphere.exr"), fixtures::bytes_of(folder / "again.exr"));
    }
  }
}

TEST(PatchSetFile, KeepsTheMarksOfCapsAndTakesNoOtherNumbers) {
  const fixtures::TestFolder folder;
  PatchSet set = fixtures::sphere_patches(fixtures::octahedron(), 2);
  for (const Vec3f& p : set.positions) set.caps.push_back(p.x > 0.5F ? 1 : 0);
  write_patch_set(folder / "capped.exr", set);
  const PatchSet back = read_patch_set(folder / "capped.exr");
  EXPECT_EQ(back.caps, set.caps);
  EXPECT_TRUE(same_bits(back.source_triangles, set.source_triangles));
  set.caps[7] = 2;
  write_patch_set(folder / "capped.exr", set);
  EXPECT_NE(refusal(folder / "capped.exr").find("neither 0 nor 1"), std::string::npos);
}

TEST(PatchSetFile, KeepsTheEmptyHalfOfAPatchOnTheBoundary) {
  // One triangle alone: three half patches.
  const fixtures::TestFolder folder;
  PatchLayout layout;
  layout.samples = 3;
  layout.places = patch_places(make_domain({{0, 1, 2}}, 3));
  layout.adjacency = patch_adjacency(layout.places);
  PatchSet set = empty_patch_set(std::move(layout));
  for (std::int32_t p = 0; p < 3; ++p) {
    for (std::int32_t j = 0; j < 3; ++j) {
      for (std::int32_t i = 0; i <= j; ++i) {
        set.source_triangles[set.index(p, i, j)] = 7;
        set.source_weights[set.index(p, i, j)] = Vec3f(0.25F, 0.25F, 0.5F);
      }
    }
  }
  write_patch_set(folder / "triangle.exr", set);
  EXPECT_TRUE(same_bits(read_patch_set(folder / "triangle.exr").source_triangles, set.source_triangles));
  set.source_triangles[set.index(1, 2, 0)] = 7;
  write_patch_set(folder / "triangle.exr", set);
  EXPECT_NE(refusal(folder / "triangle.exr").find("(2, 0) of patch 1"), std::string::npos);
}

TEST(PatchSetFile, RefusesWhatBreaksItsPromises) {
  const fixtures::TestFolder folder;
  const PatchSet good = fixtures::sphere_patches(fixtures::octahedron(), 2);
  const auto after = [&](auto change) {
    PatchSet bad = good;
    change(bad);
    write_patch_set(folder / "bad.exr", bad);
    return refusal(folder / "bad.exr");
  };
  EXPECT_EQ(after([](PatchSet&) {}), "");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(after([&](PatchSet& s) { s.positions[33].y = nan; }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.normals[33].z = nan; }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.source_weights[33].x = nan; }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.source_weights[33] = Vec3f(-0.5F, 1, 0.5F); }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.source_weights[33] = Vec3f(1, 1, 1); }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.source_triangles[33] = -1; }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.source_triangles[33] = std::numeric_limits<int>::min(); }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.layout.adjacency[3][2].side ^= 1; }), "");
  EXPECT_NE(after([&](PatchSet& s) { s.layout.places[3].a = 1 << 30; }), "");
}

TEST(PatchSetFile, RefusesAGeometryImageAndAGeometryImageReaderRefusesIt) {
  const fixtures::TestFolder folder;
  write_geometry_image(folder / "image.exr", fixtures::sphere_image(fixtures::octahedron(), 0));
  EXPECT_NE(refusal(folder / "image.exr").find("geometry image"), std::string::npos);
  write_patch_set(folder / "patches.exr", fixtures::sphere_patches(fixtures::octahedron(), 0));
  EXPECT_THROW(read_geometry_image(folder / "patches.exr"), Error);
}

TEST(PatchSetFile, RefusesAPictureThatClaimsMoreThanTheFileCanHold) {
  const fixtures::TestFolder folder;
  write_patch_set(folder / "good.exr", fixtures::sphere_patches(fixtures::octahedron(), 1));
  // The header alone says 12 patches of 16385 x 16385 samples: 120 GB.
  std::string bytes = fixtures::bytes_of(folder / "good.exr");
  const auto patch_int = [&](const std::string& name, std::size_t offset, std::int32_t value) {
    const std::size_t at = bytes.find(name);
    ASSERT_NE(at, std::string::npos);
    std::memcpy(bytes.data() + at + name.size() + offset, &value, sizeof(value));
  };
  using namespace std::string_literals;
  patch_int("lozenge.samples\0int\0"s, 4, 16385);
  patch_int("tiles\0tiledesc\0"s, 4, 16385);
  patch_int("tiles\0tiledesc\0"s, 8, 16385);
  patch_int("dataWindow\0box2i\0"s, 4 + 8, 16384);
  patch_int("dataWindow\0box2i\0"s, 4 + 12, 16385 * 12 - 1);
  fixtures::write_bytes(folder / "huge.exr", bytes);
  EXPECT_NE(refusal(folder / "huge.exr").find("too short"), std::string::npos) << refusal(folder / "huge.exr");
}

TEST(PatchSetFile, RefusesEveryTruncation) {
  const fixtures::TestFolder folder;
  write_patch_set(folder / "good.exr", fixtures::sphere_patches(fixtures::tetrahedron(), 2));
  const std::string bytes = fixtures::bytes_of(folder / "good.exr");
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 64) {
    fixtures::write_bytes(folder / "bad.exr", bytes.substr(0, length));
    EXPECT_NE(refusal(folder / "bad.exr"), "") << length << " bytes of " << bytes.size();
  }
}

}  // namespace
}  // namespace lozenge
