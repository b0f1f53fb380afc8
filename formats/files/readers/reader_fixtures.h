// What the tests of all readers share: content becomes a file, and what the file's reader says of it.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"
#include "formats/base/vector.h"
#include "formats/files/input_format.h"

namespace lozenge::fixtures {

/// A square that is bent along one diagonal, which every format can hold as a polygon of four corners.
inline const std::vector<Vec3f> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};

class ReaderTest : public testing::Test {
 protected:
  TestFolder folder_;

  InputAsset open(const std::string& name, const std::string& content, const InputLimits& limits = {}) const {
    write_bytes(folder_ / name, content);
    return open_input(folder_ / name, limits);
  }

  /// Of a file of one primitive.
  Primitive read(const std::string& name, const std::string& content) const {
    const InputAsset asset = open(name, content);
    EXPECT_EQ(asset.meshes.at(0).primitives.size(), 1U);
    return asset.read(0, 0);
  }

  /// What is wrong with it; empty where nothing is.
  std::string complaint(const std::string& name, const std::string& content, ExitCode code = ExitCode::kUnusableInput,
                        const InputLimits& limits = {}) const {
    try {
      open(name, content, limits);
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      EXPECT_EQ(std::string(error.what()).find(name), 0U) << "messages begin with the file: " << error.what();
      return error.what();
    }
  }

  void expect_refused(const std::string& name, const std::string& content, const std::string& word) const {
    const std::string message = complaint(name, content);
    EXPECT_NE(message.find(word), std::string::npos) << message;
  }
};

inline std::vector<Vec3f> positions_of(const Primitive& primitive) {
  std::vector<Vec3f> positions;
  for (std::size_t i = 0; i < primitive.positions.size(); i += 3) {
    positions.emplace_back(primitive.positions[i], primitive.positions[i + 1], primitive.positions[i + 2]);
  }
  return positions;
}

/// The values of an attribute; empty where the primitive hasn't got it.
inline std::vector<float> values_of(const Primitive& primitive, const AttributeKind& kind) {
  const AttributeStream* stream = find_stream(primitive.attributes, kind);
  return stream == nullptr ? std::vector<float>() : stream->values;
}

/// The attribute's values at the corners of all triangles.
inline std::vector<float> corner_values(const Primitive& primitive, const AttributeKind& kind) {
  std::vector<float> values;
  const AttributeStream* stream = find_stream(primitive.attributes, kind);
  for (const auto& triangle : primitive.triangles) {
    for (const std::uint32_t v : triangle) {
      values.insert(values.end(), stream->at(v), stream->at(v) + kind.components);
    }
  }
  return values;
}

/// The square as two triangles around its first corner, its vertices in the file's order.
inline void expect_square(const Primitive& primitive) {
  EXPECT_EQ(positions_of(primitive), kSquare);
  EXPECT_EQ(primitive.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

/// What sRGB's byte 128 is in linear light: ((128 / 255 + 0.055) / 1.055)^2.4.
inline constexpr float kHalfGray = 0.2158605F;

inline void expect_near(const std::vector<float>& found, const std::vector<float>& wanted) {
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-6) << i;
}

}  // namespace lozenge::fixtures
