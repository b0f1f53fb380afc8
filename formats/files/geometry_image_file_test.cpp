#include "formats/files/geometry_image_file.h"

#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfStringAttribute.h>
#include <ImfStringVectorAttribute.h>
#include <ImfTileDescription.h>
#include <ImfVecAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/domain/sphere_fixtures.h"
#include "formats/files/exr_fixtures.h"
#include "formats/patches/image_fixtures.h"
#include "formats/surface/body_fixtures.h"

namespace lozenge {
namespace {

using fixtures::ExrPart;
using Parts = std::vector<ExrPart>;

/// A body in places that are hard to write down, of which the second one is moved by a node.
Body ball() {
  std::mt19937 random(1);
  return {"ball \"1\"", {{}, {fixtures::random_placement(random), 3}, {fixtures::random_placement(random), -1}}, -1};
}

/// One skin, whose joints and weights differ from sample to sample.
void add_skin(GeometryImage& image) {
  image.layout.bodies = {{{"skin", {{}}, 0}}, std::vector(image.layout.places.size(), 0)};
  for (GeometryLevel& level : image.levels) {
    level.influences.assign(kInfluences.components * level.positions.size(), 0.0F);
    for (std::int32_t patch = 0; patch < image.size(); ++patch) {
      for (std::int32_t j = 0; j < level.samples; ++j) {
        for (std::int32_t i = 0; i < level.samples; ++i) {
          const std::size_t texel = image.index(level, patch, i, j);
          float* influence = &level.influences[kInfluences.components * texel];
          influence[0] = 17;
          influence[kMostJoints + 1] = level.positions[texel].x * level.positions[texel].x / 2;
          influence[kMostJoints] = 1 - influence[kMostJoints + 1];
        }
      }
    }
  }
}

std::vector<GeometryImage> images() {
  std::vector<GeometryImage> found;
  for (const Domain& base : {fixtures::tetrahedron(), fixtures::octahedron(), fixtures::icosahedron()}) {
    for (const int k : {0, 1, 2, 4}) found.push_back(fixtures::sphere_image(base, k));
  }
  found.push_back(fixtures::open_image(fixtures::two_scales(2), 3));
  found.back().layout.material_classes.assign(found.back().layout.places.size(), 0);
  found.back().layout.material_classes[3] = 5;
  found.back().layout.translation = {500000.125, 4e6, -3};
  found.back().layout.scene_name = "Bj\xc3\xb6rn's \"statue\"\n\\";
  found.back().layout.origin = "";
  found.back().layout.double_sided = true;
  for (GeometryImage& image : found) {
    if (image.layout.samples == 3) image.layout.bodies = {{ball()}, std::vector(image.layout.places.size(), 0)};
    if (image.layout.samples == 5) add_skin(image);
  }
  return found;
}

bool same_bits(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0;
}

bool same(const PatchPlace& a, const PatchPlace& b) {
  return a.a == b.a && a.b == b.b && a.left == b.left && a.right == b.right;
}

/// The message of the refusal, or "" where the file was read.
std::string refusal(const std::filesystem::path& file) {
  try {
    read_geometry_image(file);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUnusableInput) << e.what();
    EXPECT_NE(std::string(e.what()).find(file.string()), std::string::npos) << e.what();
    return e.what();
  }
  return "";
}

TEST(GeometryImageFile, GivesBackTheSameBitsThatWereWritten) {
  const fixtures::TestFolder folder;
  for (const GeometryImage& image : images()) {
    write_geometry_image(folder / "sphere.gim.exr", image);
    const GeometryImage back = read_geometry_image(folder / "sphere.gim.exr");
    EXPECT_EQ(back.layout.samples, image.layout.samples);
    EXPECT_EQ(back.columns, image.columns);
    EXPECT_EQ(back.levels.front().rows, image.levels.front().rows);
    EXPECT_EQ(back.layout.adjacency, image.layout.adjacency);
    EXPECT_TRUE(std::equal(back.layout.places.begin(), back.layout.places.end(), image.layout.places.begin(),
                           image.layout.places.end(), same));
    EXPECT_EQ(back.layout.bounds.low, image.layout.bounds.low);
    EXPECT_EQ(back.layout.bounds.high, image.layout.bounds.high);
    EXPECT_EQ(back.layout.scene_name, image.layout.scene_name);
    EXPECT_EQ(back.layout.origin, image.layout.origin);
    EXPECT_EQ(back.layout.double_sided, image.layout.double_sided);
    EXPECT_EQ(back.layout.first_levels, image.layout.first_levels);
    EXPECT_EQ(back.layout.material_classes, image.layout.material_classes);
    EXPECT_EQ(back.layout.translation, image.layout.translation);
    fixtures::expect_same(back.layout.bodies, image.layout.bodies);
    ASSERT_EQ(back.levels.size(), image.levels.size());
    for (std::size_t l = 0; l < image.levels.size(); ++l) {
      EXPECT_EQ(back.levels[l].samples, image.levels[l].samples);
      EXPECT_EQ(back.levels[l].influences, image.levels[l].influences);
      EXPECT_TRUE(same_bits(back.levels[l].positions, image.levels[l].positions));
      EXPECT_TRUE(same_bits(back.levels[l].normals, image.levels[l].normals));
    }
  }
}

/// A sphere on which the samples above this height close a hole.
GeometryImage capped_sphere(float height) {
  GeometryImage image = fixtures::sphere_image(fixtures::icosahedron(), 3);
  for (GeometryLevel& level : image.levels) {
    for (const Vec3f& p : level.positions) level.caps.push_back(p.z > height ? 1 : 0);
  }
  return image;
}

TEST(GeometryImageFile, KeepsTheMarksOfCaps) {
  const fixtures::TestFolder folder;
  const GeometryImage image = capped_sphere(0.5F);
  write_geometry_image(folder / "a.exr", image);
  const GeometryImage back = read_geometry_image(folder / "a.exr");
  for (std::size_t l = 0; l < image.levels.size(); ++l) EXPECT_EQ(back.levels[l].caps, image.levels[l].caps);
  EXPECT_TRUE(same_bits(back.levels[1].positions, image.levels[1].positions));
  write_geometry_image(folder / "b.exr", back);
  EXPECT_EQ(fixtures::bytes_of(folder / "a.exr"), fixtures::bytes_of(folder / "b.exr"));
}

TEST(GeometryImageFile, RefusesMarksOfCapsThatContradictEachOther) {
  const fixtures::TestFolder folder;
  const auto after = [&](const auto& change) {
    GeometryImage image = capped_sphere(0.5F);
    change(image);
    write_geometry_image(folder / "a.exr", image);
    return refusal(folder / "a.exr");
  };
  const auto mark = [](GeometryImage& image, std::int32_t i, std::int32_t j) -> std::uint32_t& {
    return image.levels.front().caps[image.index(image.levels.front(), 0, i, j)];
  };
  EXPECT_EQ(after([](GeometryImage&) {}), "");
  EXPECT_NE(after([&](GeometryImage& image) { mark(image, 3, 3) = 2; }).find("marks a cap with 2"), std::string::npos);
  for (const auto& place : {std::pair(0, 3), {4, 0}, {0, 0}, {8, 8}}) {
    const auto changed = [&](GeometryImage& image) { mark(image, place.first, place.second) ^= 1; };
    EXPECT_NE(after(changed).find("on a cap in one patch alone"), std::string::npos);
  }
  EXPECT_EQ(after([&](GeometryImage& image) { mark(image, 3, 3) ^= 1; }), "");
}

TEST(GeometryImageFile, RefusesBodiesThatMakeNoSense) {
  const fixtures::TestFolder folder;
  const auto after = [&](const auto& change) {
    GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 1);
    image.layout.bodies = {{ball()}, std::vector(image.layout.places.size(), 0)};
    change(image.layout.bodies);
    write_geometry_image(folder / "a.exr", image);
    return refusal(folder / "a.exr");
  };
  const auto says = [](const std::string& message, const char* words) {
    return message.find(words) != std::string::npos;
  };
  EXPECT_EQ(after([](Bodies&) {}), "");
  EXPECT_TRUE(says(after([](Bodies& b) { b.owner[3] = -1; }), "belong to different bodies"));
  EXPECT_TRUE(says(after([](Bodies& b) { b.owner[3] = 1; }), "belongs to body 1 of 1"));
  EXPECT_TRUE(says(after([](Bodies& b) { b.owner.pop_back(); }), "11 of 12 know"));
  EXPECT_TRUE(says(after([](Bodies& b) { b.bodies[0].places.clear(); }), "has no place"));
  EXPECT_TRUE(says(after([](Bodies& b) { b.bodies[0].places[1].placement[5] = NAN; }), "16 numbers"));
  EXPECT_TRUE(says(after([](Bodies& b) { b.bodies[0].places[2].placement[4] += 9; }), "no translation, rotation"));
  EXPECT_TRUE(says(after([](Bodies& b) { b.bodies[0] = {"", {{}}, 0}; }), "samples have no joints"));
}

TEST(GeometryImageFile, TakesTheRepeatedMeshesOfTheFirstVersionForBodies) {
  const fixtures::TestFolder folder;
  GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 1);
  image.layout.bodies = {{ball()}, std::vector(image.layout.places.size(), 0)};
  for (BodyPlace& place : image.layout.bodies.bodies[0].places) place.node = -1;
  write_geometry_image(folder / "new.exr", image);
  fixtures::rewrite_exr(folder / "new.exr", folder / "old.exr", [&](Parts& parts) {
    Imf::Header& header = parts[0].header;
    std::vector<std::string> copies;
    for (const Placement& copy : copies_of(image.layout.bodies.bodies[0])) {
      copies.push_back(fmt::format("0 {}", fmt::join(copy, " ")));
    }
    header.insert("lozenge.version", Imf::IntAttribute(1));
    header.insert("lozenge.repeatedNames", Imf::StringVectorAttribute({"ball \"1\""}));
    header.insert("lozenge.repeatedCopies", Imf::StringVectorAttribute(copies));
    header.insert("lozenge.repeatedOf", Imf::StringVectorAttribute(Imf::StringVector(image.layout.places.size(), "0")));
    for (const char* name : {"bodyNames", "bodySkins", "bodyPlaces", "bodyOf"}) {
      fixtures::remove_attribute(header, std::string("lozenge.") + name);
    }
  });
  fixtures::expect_same(read_geometry_image(folder / "old.exr").layout.bodies, image.layout.bodies);
}

TEST(GeometryImageFile, RefusesJointsAndWeightsThatMakeNoSense) {
  const fixtures::TestFolder folder;
  const auto after = [&](const auto& change) {
    GeometryImage image = fixtures::sphere_image(fixtures::octahedron(), 2);
    add_skin(image);
    change(image);
    write_geometry_image(folder / "a.exr", image);
    return refusal(folder / "a.exr");
  };
  const auto at = [](GeometryImage& image, std::int32_t i, std::int32_t j) {
    GeometryLevel& level = image.levels.front();
    return &level.influences[kInfluences.components * image.index(level, 0, i, j)];
  };
  const auto says = [](const std::string& message, const char* words) {
    return message.find(words) != std::string::npos;
  };
  EXPECT_EQ(after([](GeometryImage&) {}), "");
  EXPECT_TRUE(says(after([&](GeometryImage& g) { at(g, 1, 2)[0] = 0.5F; }), "joints or weights that are none"));
  EXPECT_TRUE(
      says(after([&](GeometryImage& g) { at(g, 1, 2)[kMostJoints] += 0.5F; }), "joints or weights that are none"));
  EXPECT_TRUE(
      says(after([&](GeometryImage& g) { at(g, 1, 2)[kMostJoints] = NAN; }), "joints or weights that are none"));
  EXPECT_TRUE(says(after([&](GeometryImage& g) { std::fill_n(at(g, 1, 2), kInfluences.components, 0.0F); }),
                   "no joint that moves it"));
  EXPECT_TRUE(says(after([&](GeometryImage& g) { at(g, 0, 2)[0] = 16; }), "other joints in one patch"));
  EXPECT_TRUE(says(after([&](GeometryImage& g) { g.layout.bodies = {}; }), "has joints, but no skin"));
}

TEST(GeometryImageFile, IsTheSameBytesEveryTime) {
  const fixtures::TestFolder folder;
  for (const GeometryImage& image : images()) {
    write_geometry_image(folder / "a.exr", image);
    write_geometry_image(folder / "b.exr", read_geometry_image(folder / "a.exr"));
    EXPECT_EQ(fixtures::bytes_of(folder / "a.exr"), fixtures::bytes_of(folder / "b.exr"));
    EXPECT_EQ(fixtures::bytes_of(folder / "a.json"), fixtures::bytes_of(folder / "b.json"));
  }
}

TEST(GeometryImageFile, SaysTheSameInTheJsonBesideIt) {
  const fixtures::TestFolder folder;
  for (const GeometryImage& image : images()) {
    write_geometry_image(folder / "sphere.gim.exr", image);
    const nlohmann::json json = nlohmann::json::parse(fixtures::bytes_of(folder / "sphere.gim.json"));
    EXPECT_EQ(json["version"], kGeometryImageVersion);
    EXPECT_EQ(json["scene"], image.layout.scene_name);
    EXPECT_EQ(json["samples"], image.layout.samples);
    EXPECT_EQ(json["doubleSided"], image.layout.double_sided);
    ASSERT_EQ(json.contains("firstLevels"), !image.layout.first_levels.empty());
    if (json.contains("firstLevels")) {
      EXPECT_EQ(json["firstLevels"], image.layout.first_levels);
    }
    ASSERT_EQ(json.contains("materialClasses"), !image.layout.material_classes.empty());
    if (json.contains("materialClasses")) {
      EXPECT_EQ(json["materialClasses"], image.layout.material_classes);
    }
    EXPECT_EQ(json["translation"][0], image.layout.translation.x);
    const Bodies& bodies = image.layout.bodies;
    ASSERT_EQ(json.contains("bodies"), !bodies.empty());
    for (std::size_t b = 0; b < bodies.bodies.size(); ++b) {
      EXPECT_EQ(json["bodies"][b]["name"], bodies.bodies[b].name);
      EXPECT_EQ(json["bodies"][b]["skin"], bodies.bodies[b].skin);
      ASSERT_EQ(json["bodies"][b]["places"].size(), bodies.bodies[b].places.size());
      for (std::size_t p = 0; p < bodies.bodies[b].places.size(); ++p) {
        EXPECT_EQ(json["bodies"][b]["places"][p]["node"], bodies.bodies[b].places[p].node);
        EXPECT_EQ(json["bodies"][b]["places"][p]["placement"], bodies.bodies[b].places[p].placement);
      }
      EXPECT_EQ(json["bodyOf"], bodies.owner);
    }
    EXPECT_EQ(json["columns"], image.columns);
    EXPECT_EQ(json["levels"].size(), image.levels.size());
    ASSERT_EQ(json["adjacency"].size(), image.layout.adjacency.size());
    for (std::size_t p = 0; p < image.layout.adjacency.size(); ++p) {
      const PatchPlace& at = image.layout.places[p];
      EXPECT_EQ(json["places"][p],
                (std::vector{at.a, at.b, at.left.triangle, at.left.side, at.right.triangle, at.right.side}));
      for (std::size_t side = 0; side < 4; ++side) {
        const PatchSide other = image.layout.adjacency[p][side];
        EXPECT_EQ(json["adjacency"][p][side], other.patch < 0 ? -1 : 4 * other.patch + other.side);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(json["bounds"]["low"][axis].get<float>(), image.layout.bounds.low[axis]);
    }
  }
}

TEST(GeometryImageFile, LeavesNothingWhereItCannotBeWritten) {
  const fixtures::TestFolder folder;
  EXPECT_THROW(write_geometry_image(folder / "missing/sphere.gim.exr", images().front()), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "missing"));
}

/// A good file, and a way to ask whether a changed copy is refused.
class Broken : public testing::Test {
 protected:
  Broken() { write_geometry_image(good_, image_); }

  std::string after(const std::function<void(Parts&)>& change) {
    fixtures::rewrite_exr(good_, bad_, change);
    return refusal(bad_);
  }
  static void set_row(Imf::Header& header, const char* name, std::size_t row, const std::string& text) {
    auto rows = header.typedAttribute<Imf::StringVectorAttribute>(name).value();
    rows.at(row) = text;
    header.insert(name, Imf::StringVectorAttribute(rows));
  }

  fixtures::TestFolder folder_;
  GeometryImage image_ = fixtures::sphere_image(fixtures::tetrahedron(), 3);  // six patches in 3 x 2 tiles of 9
  std::filesystem::path good_ = folder_ / "good.exr";
  std::filesystem::path bad_ = folder_ / "bad.exr";
};

TEST_F(Broken, CopyWithoutAChangeIsRead) {
  EXPECT_EQ(after([](Parts&) {}), "");
}

TEST_F(Broken, EveryAttributeIsMissed) {
  for (const char* name :
       {"lozenge.kind", "lozenge.version", "lozenge.samples", "lozenge.patches", "lozenge.columns", "lozenge.rows",
        "lozenge.level", "lozenge.levels", "lozenge.places", "lozenge.adjacency", "lozenge.boundsLow",
        "lozenge.boundsHigh", "lozenge.scene", "lozenge.origin", "lozenge.doubleSided"}) {
    const std::string message = after([&](Parts& parts) { fixtures::remove_attribute(parts[0].header, name); });
    EXPECT_NE(message.find(name), std::string::npos) << message;
    EXPECT_NE(after([&](Parts& parts) {
                fixtures::remove_attribute(parts[0].header, name);
                parts[0].header.insert(name, Imf::DoubleAttribute(1));
              }),
              "")
        << name << " of another type";
  }
}

TEST_F(Broken, EveryNumberMustFit) {
  const int lowest = std::numeric_limits<int>::min();
  const int highest = std::numeric_limits<int>::max();
  for (const char* name : {"lozenge.version", "lozenge.samples", "lozenge.patches", "lozenge.columns", "lozenge.rows",
                           "lozenge.level", "lozenge.levels"}) {
    for (const int wrong : {lowest, -1, 0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 17, 65537, highest}) {
      int value = 0;
      const std::string message = after([&](Parts& parts) {
        value = parts[0].header.typedAttribute<Imf::IntAttribute>(name).value();
        parts[0].header.insert(name, Imf::IntAttribute(wrong));
      });
      const bool is_first_version = name == std::string("lozenge.version") && wrong == 1;
      EXPECT_EQ(message.empty(), value == wrong || is_first_version) << name << " = " << wrong;
    }
  }
}

TEST_F(Broken, FirstLevelsMustBeThoseOfParts) {
  const auto with = [&](const std::vector<std::string>& rows) {
    return after(
        [&](Parts& parts) { parts[0].header.insert("lozenge.firstLevels", Imf::StringVectorAttribute(rows)); });
  };
  EXPECT_EQ(with({"0", "0", "0", "0", "0", "0"}), "");
  EXPECT_NE(with({"0", "0", "0", "0", "0"}).find("5 rows, not 6"), std::string::npos);
  EXPECT_NE(with({"0", "0", "0", "0", "0", "1"}).find("touch"), std::string::npos);
  EXPECT_NE(with({"1", "1", "1", "1", "1", "0"}), "");
  EXPECT_NE(with({"4", "4", "4", "4", "4", "4"}).find("not 0 to 3"), std::string::npos);
  EXPECT_NE(with({"-1", "-1", "-1", "-1", "-1", "-1"}).find("not 0 to 3"), std::string::npos);
  EXPECT_NE(with({"0", "0", "a", "0", "0", "0"}).find("whole numbers"), std::string::npos);
}

TEST_F(Broken, MaterialClassesMustBeKnownOnes) {
  const auto with = [&](const std::vector<std::string>& rows) {
    return after(
        [&](Parts& parts) { parts[0].header.insert("lozenge.materialClasses", Imf::StringVectorAttribute(rows)); });
  };
  EXPECT_EQ(with({"0", "1", "0", "5", "0", "0"}), "");
  EXPECT_NE(with({"0", "1", "0", "6", "0", "0"}).find("not 0 to 5"), std::string::npos);
  EXPECT_NE(with({"0", "1"}).find("2 rows, not 6"), std::string::npos);
}

TEST_F(Broken, ATranslationMustBeFinite) {
  const auto with = [&](double x) {
    return after([&](Parts& parts) {
      parts[0].header.insert("lozenge.translation", Imf::V3dAttribute(Imath::V3d(5e5, 4e6, x)));
    });
  };
  EXPECT_EQ(with(-100), "");
  EXPECT_NE(with(std::nan("")).find("not finite"), std::string::npos);
}

TEST_F(Broken, WhatIsDoubleSidedMustBeZeroOrOne) {
  for (const int value : {-1, 0, 1, 2}) {
    const std::string message =
        after([&](Parts& parts) { parts[0].header.insert("lozenge.doubleSided", Imf::IntAttribute(value)); });
    EXPECT_EQ(message.empty(), value == 0 || value == 1) << message;
  }
}

TEST_F(Broken, PlacesAndAdjacencyMustBeNumbersThatFit) {
  const std::vector<std::string> nonsense{"",
                                          " ",
                                          "a",
                                          "1",
                                          "1 2 3",
                                          "0 0 0 0",
                                          "0 1 2 3 4",
                                          "-1 -1 -1 -1",
                                          "1e3 1 1",
                                          "0 1 0 0 1",
                                          "0 1 0 0 1 1 1",
                                          "0x1 1 1 1",
                                          "99999999999 0 0 0",
                                          "2147483647 2147483647 2147483647 2147483647"};
  for (const char* name : {"lozenge.places", "lozenge.adjacency"}) {
    for (std::size_t row = 0; row < 6; ++row) {
      for (const std::string& text : nonsense) {
        EXPECT_NE(after([&](Parts& parts) { set_row(parts[0].header, name, row, text); }), "") << name << ": " << text;
      }
    }
    EXPECT_NE(after([&](Parts& parts) { parts[0].header.insert(name, Imf::StringVectorAttribute()); }), "");
  }
}

TEST_F(Broken, EveryNeighbourMustBeTheRightOne) {
  for (std::size_t patch = 0; patch < 6; ++patch) {
    for (std::size_t side = 0; side < 4; ++side) {
      const std::string message = after([&](Parts& parts) {
        std::string row;
        for (std::size_t s = 0; s < 4; ++s) {
          const PatchSide other = image_.layout.adjacency[patch][s];
          if (s > 0) row += " ";
          row += std::to_string((4 * other.patch + other.side + (s == side ? 1 : 0)) % 24);
        }
        set_row(parts[0].header, "lozenge.adjacency", patch, row);
      });
      EXPECT_NE(message.find("side " + std::to_string(side) + " of patch " + std::to_string(patch)), std::string::npos)
          << message;
    }
  }
}

TEST_F(Broken, BoundsMustBeFiniteInOrderAndHoldTheSamples) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Imath::V3f& high :
       {Imath::V3f(nan, 1, 1), Imath::V3f(1, infinity, 1), Imath::V3f(1, 1, -2), Imath::V3f(0.5F, 1, 1)}) {
    EXPECT_NE(after([&](Parts& parts) { parts[0].header.insert("lozenge.boundsHigh", Imf::V3fAttribute(high)); }), "");
  }
}

TEST_F(Broken, ChannelsMustBeTheSixFloats) {
  EXPECT_NE(after([](Parts& p) { p[1].header.channels().insert("Z", Imf::Channel(Imf::FLOAT)); }), "");
  EXPECT_NE(after([](Parts& p) { p[0].header.channels().insert("P.X", Imf::Channel(Imf::UINT)); }), "");
  EXPECT_NE(after([](Parts& p) { p[2].header.channels().insert("N.Z", Imf::Channel(Imf::UINT)); }), "");
}

TEST_F(Broken, PicturesAndTilesMustHaveTheirLevelsSizes) {
  const auto window = [](int level, Imath::Box2i box) {
    return [=](Parts& parts) {
      parts[level].header.dataWindow() = box;
      parts[level].channels.clear();
    };
  };
  EXPECT_NE(after(window(0, {{0, 0}, {27, 17}})), "");
  EXPECT_NE(after(window(0, {{0, 0}, {26, 16}})), "");
  EXPECT_NE(after(window(1, {{0, 0}, {26, 17}})), "");
  EXPECT_NE(after([](Parts& p) { p[0].header.setTileDescription(Imf::TileDescription(8, 9, Imf::ONE_LEVEL)); }), "");
  EXPECT_NE(after([](Parts& p) { p[3].header.setTileDescription(Imf::TileDescription(1, 1, Imf::ONE_LEVEL)); }), "");
  EXPECT_NE(after([](Parts& p) { p.pop_back(); }), "");
  EXPECT_NE(after([](Parts& p) { p.erase(p.begin() + 1); }), "");
  EXPECT_NE(after([](Parts& p) { p.erase(p.begin()); }), "");
  EXPECT_NE(after([](Parts& p) { std::swap(p[1], p[2]); }), "");
}

TEST_F(Broken, SamplesMustKeepTheirPromises) {
  const auto sample = [this](std::size_t part, int channel, std::size_t texel, float value) {
    return after(
        [&](Parts& parts) { std::memcpy(&parts[part].channels.at(channel).at(texel), &value, sizeof(float)); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(sample(0, 3, 10 + 27 * 4, nan).find("not finite"), std::string::npos);
  EXPECT_NE(sample(0, 0, 12 + 27 * 3, nan).find("not finite"), std::string::npos);
  EXPECT_NE(sample(0, 4, 10 + 27 * 4, 3.0F).find("outside the bounds"), std::string::npos);
  EXPECT_NE(sample(0, 1, 10 + 27 * 4, 0.9F).find("unit vector"), std::string::npos);
  // Sample (0, 4) of patch 0 lies on a border; (1, 1) inside, where level 0 alone has it; (2, 2) in level 1, too.
  EXPECT_NE(sample(0, 5, 27 * 4, 0.123F).find("neighbour"), std::string::npos);
  EXPECT_EQ(sample(0, 5, 1 + 27, 0.123F), "");
  EXPECT_NE(sample(0, 5, 2 + 27 * 2, 0.123F).find("differs from sample"), std::string::npos);
  EXPECT_NE(sample(3, 5, 0, 0.123F).find("differs from sample"), std::string::npos);
}

TEST(GeometryImageFile, RefusesATileWithoutAPatchThatIsNotEmpty) {
  const fixtures::TestFolder folder;
  const GeometryImage image = fixtures::sphere_image(fixtures::icosahedron(), 1);  // 30 patches in 6 x 5 tiles
  GeometryImage wider = image;
  wider.columns = 7;
  for (GeometryLevel& level : wider.levels) {
    const GeometryLevel from = level;
    level.positions.assign(static_cast<std::size_t>(wider.width(level)) * wider.height(level), Vec3f(0, 0, 0));
    level.normals = level.positions;
    for (std::int32_t p = 0; p < image.size(); ++p) {
      for (std::int32_t j = 0; j < level.samples; ++j) {
        for (std::int32_t i = 0; i < level.samples; ++i) {
          level.positions[wider.index(level, p, i, j)] = from.positions[image.index(from, p, i, j)];
          level.normals[wider.index(level, p, i, j)] = from.normals[image.index(from, p, i, j)];
        }
      }
    }
  }
  write_geometry_image(folder / "wide.exr", wider);
  EXPECT_EQ(refusal(folder / "wide.exr"), "");
  wider.levels[0].positions.back().x = 1e-30F;
  write_geometry_image(folder / "wide.exr", wider);
  EXPECT_NE(refusal(folder / "wide.exr").find("tile 34"), std::string::npos);
}

TEST_F(Broken, EveryTruncationIsRefused) {
  const std::string bytes = fixtures::bytes_of(good_);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 64) {
    fixtures::write_bytes(bad_, bytes.substr(0, length));
    EXPECT_NE(refusal(bad_), "") << length << " bytes of " << bytes.size();
  }
  fixtures::write_bytes(bad_, bytes.substr(0, bytes.size() - 1));
  EXPECT_NE(refusal(bad_), "");
  EXPECT_NE(refusal(folder_ / "missing.exr"), "");
}

TEST_F(Broken, ChangedBytesAreReadOrRefused) {
  const std::string bytes = fixtures::bytes_of(good_);
  std::mt19937 random(5);
  int refused = 0;
  for (int round = 0; round < 600; ++round) {
    std::string changed = bytes;
    // Half of the changes in the headers, which fill the start.
    const std::size_t reach = round % 2 == 0 ? bytes.size() : 2000;
    for (int n = 0; n <= round % 3; ++n) changed[random() % reach] = static_cast<char>(random());
    fixtures::write_bytes(bad_, changed);
    refused += refusal(bad_).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace lozenge
