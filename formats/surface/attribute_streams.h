// What is done to all attributes of a mesh at once, whatever they are: corners are taken over, left out, reordered,
// joined, halved and turned, and new ones are made between others.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/base/vector.h"
#include "formats/surface/attribute.h"
#include "formats/surface/normal_transform.h"

namespace lozenge {

// Elements are what a stream has a value for: vertices of a primitive, or corners of a surface, three for each
// triangle.

/// More than any kind has.
inline constexpr int kMostComponents = 16;

/// The stream of this kind and set; a new one, without values, in its place in the order of the table where there is
/// none yet.
AttributeStream& stream_for(AttributeStreams& streams, const AttributeKind& kind, int set = 0);

/// The same streams, without values.
AttributeStreams empty_like(const AttributeStreams& streams);

/// "normals", "texture coordinates 1": for people.
std::string label_of(const AttributeStream& stream);

/// Whether all directions are of unit length, but for what storing them as floats takes.
bool all_unit(const AttributeStream& stream, std::span<const float> values);

// Fitting and moving

/// Appends values from a file: repaired where they don't make sense, moved, without -0.
/// \return how many elements were repaired
std::int64_t append_fitted(AttributeStream& to, std::span<const float> values, const NormalTransform& transform);

/// Appends neutral values up to `count` elements.
void fill_up(AttributeStream& stream, std::size_t count);

// Between others

struct WeightedElement {
  std::size_t element = 0;
  double weight = 0;  ///< not negative; their sum needn't be 1
};

/// The value between some, as the stream's kind says. \param value  [component]
/// \pre `elements` isn't empty, and their weights' sum is positive
void interpolate(const AttributeStream& stream, std::span<const WeightedElement> elements, float* value);

/// The same for all streams, each of one element.
AttributeStreams interpolated(const AttributeStreams& streams, std::span<const WeightedElement> elements);

// Elements

/// Appends one element to each stream. \pre both have the same streams; they may be the same
void append_element(AttributeStreams& to, const AttributeStreams& from, std::size_t element);

/// Appends all elements of `from` to the `count` that are there. What only one of them has is neutral in the other.
void join(AttributeStreams& to, std::size_t count, const AttributeStreams& from, std::size_t from_count);

// Triangles

/// Appends a triangle's three corners. \pre both have the same streams
void append_triangle(AttributeStreams& to, const AttributeStreams& from, TriangleId t);

/// Triangle i is what triangle order[i] was; it may name some twice, and others not at all.
void reorder_triangles(AttributeStreams& corners, std::span<const TriangleId> order);

/// Those that aren't kept go.
void keep_triangles(AttributeStreams& corners, const std::vector<bool>& keep);

/// The triangle (a, b, c) whose corner a is number `corner` becomes (a, m, c), and (m, b, c) is appended. \param share
/// of the way from a to b where m lies
void halve_triangle(AttributeStreams& corners, std::size_t corner, double share = 0.5);

/// Swaps the second and third corner. Normals that faced outward do so again. \param outside  a normal of the triangle
/// before
void turn_triangle(AttributeStreams& corners, TriangleId t, const Vec3d& outside);

// For files

/// Values of some elements. \param width  floats of an element
template <typename Index>
std::vector<float> gathered(const std::vector<float>& values, std::size_t width, std::span<const Index> elements) {
  std::vector<float> taken;
  taken.resize(width * elements.size());
  float* to = taken.data();
  // The compiler knows how much it copies.
  const auto copy = [&]<std::size_t kWidth>() {
    for (const Index element : elements) {
      const float* from = &values[kWidth * static_cast<std::size_t>(element)];
      for (std::size_t c = 0; c < kWidth; ++c) *to++ = from[c];
    }
  };
  switch (width) {
    case 1:
      copy.template operator()<1>();
      break;
    case 2:
      copy.template operator()<2>();
      break;
    case 3:
      copy.template operator()<3>();
      break;
    case 4:
      copy.template operator()<4>();
      break;
    default:
      for (const Index element : elements) {
        const float* from = &values[width * static_cast<std::size_t>(element)];
        for (std::size_t c = 0; c < width; ++c) *to++ = from[c];
      }
  }
  return taken;
}

}  // namespace lozenge
