#include "formats/surface/attribute_streams.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace lozenge {

namespace {

using Value = std::array<double, kMostComponents>;

std::size_t width_of(const AttributeStream& stream) { return static_cast<std::size_t>(stream.kind.components); }

/// Its place in the table; what isn't in there comes after all that is.
std::size_t rank_of(const AttributeKind& kind) {
  return static_cast<std::size_t>(std::find(kAttributeKinds.begin(), kAttributeKinds.end(), kind) -
                                  kAttributeKinds.begin());
}

bool comes_before(const AttributeStream& a, const AttributeStream& b) {
  const std::size_t rank_a = rank_of(a.kind);
  const std::size_t rank_b = rank_of(b.kind);
  if (rank_a != rank_b) return rank_a < rank_b;
  return a.kind == b.kind ? a.set < b.set : a.kind.semantic < b.kind.semantic;
}

/// \return whether it was fit
bool fit(const AttributeKind& kind, float* value) {
  const auto components = static_cast<std::size_t>(kind.components);
  bool fits = true;
  if (kind.range == ValueRange::kUnitInterval) {
    for (std::size_t c = 0; c < components; ++c) {
      fits = fits && value[c] >= 0 && value[c] <= 1;
      value[c] = std::isfinite(value[c]) ? std::clamp(value[c], 0.0F, 1.0F) : kind.neutral;
    }
    return fits;
  }
  fits = std::all_of(value, value + components, [](float x) { return std::isfinite(x); });
  if (!fits) std::fill_n(value, components, kind.neutral);
  return fits;
}

void move(const AttributeKind& kind, const NormalTransform& transform, float* value) {
  if (kind.movement == Movement::kNone) return;
  const Vec3f given(value[0], value[1], value[2]);
  const Vec3f moved = kind.movement == Movement::kNormal ? transform(given) : transform.offset(given);
  for (int axis = 0; axis < 3; ++axis) value[axis] = moved[axis];
}

/// -0 is never stored.
void store(const Value& from, std::size_t components, float* to) {
  for (std::size_t c = 0; c < components; ++c) to[c] = static_cast<float>(from[c]) + 0.0F;
}

Value weighted_sum(const AttributeStream& stream, std::span<const WeightedElement> elements) {
  Value sum{};
  for (const auto& [element, weight] : elements) {
    const float* from = stream.at(element);
    for (std::size_t c = 0; c < width_of(stream); ++c) sum[c] += weight * from[c];
  }
  return sum;
}

double total_weight(std::span<const WeightedElement> elements) {
  double total = 0;
  for (const WeightedElement& each : elements) total += each.weight;
  return total;
}

void interpolate_linear(const AttributeStream& stream, std::span<const WeightedElement> elements, float* value) {
  Value sum = weighted_sum(stream, elements);
  const double total = total_weight(elements);
  for (double& x : sum) x /= total;
  store(sum, width_of(stream), value);
}

void interpolate_direction(const AttributeStream& stream, std::span<const WeightedElement> elements, float* value) {
  // What rounding leaves of unit vectors that cancel has no direction.
  constexpr double kCancelled = 1e-6;
  Value sum = weighted_sum(stream, elements);
  double squares = 0;
  for (std::size_t c = 0; c < width_of(stream); ++c) squares += sum[c] * sum[c];
  const double length = std::sqrt(squares);
  for (double& x : sum) x = length > kCancelled * total_weight(elements) ? x / length : 0;
  store(sum, width_of(stream), value);
}

/// Of weights that add up to 1 again.
void interpolate_joints(const AttributeStream& stream, std::span<const WeightedElement> elements, float* value) {
  struct Influence {
    float joint = 0;
    double weight = 0;
  };
  const std::size_t most = width_of(stream) / 2;
  std::vector<Influence> influences;
  std::size_t kept = kJointsOfSet;
  for (const auto& [element, weight] : elements) {
    const float* joints = stream.at(element);
    const auto own = std::count_if(joints + most, joints + 2 * most, [](float w) { return w > 0; });
    kept = std::max(kept, static_cast<std::size_t>(own));
    for (std::size_t i = 0; i < most; ++i) {
      const double share = weight * joints[most + i];
      if (!(share > 0)) continue;
      const auto known = std::find_if(influences.begin(), influences.end(),
                                      [&](const Influence& influence) { return influence.joint == joints[i]; });
      if (known == influences.end()) influences.push_back({joints[i], share});
      else known->weight += share;
    }
  }
  std::stable_sort(influences.begin(), influences.end(),
                   [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
  kept = std::min(kept, most);
  if (influences.size() > kept) influences.resize(kept);
  double total = 0;
  for (const Influence& influence : influences) total += influence.weight;
  std::fill_n(value, width_of(stream), 0.0F);
  for (std::size_t i = 0; i < influences.size(); ++i) {
    value[i] = influences[i].joint;
    value[most + i] = static_cast<float>(influences[i].weight / total);
  }
}

void interpolate_nearest(const AttributeStream& stream, std::span<const WeightedElement> elements, float* value) {
  const auto nearest =
      std::max_element(elements.begin(), elements.end(),
                       [](const WeightedElement& a, const WeightedElement& b) { return a.weight < b.weight; });
  std::copy_n(stream.at(nearest->element), width_of(stream), value);
}

/// Three corners of a triangle are as one element that is three times as wide.
std::size_t triangle_width(const AttributeStream& stream) { return 3 * width_of(stream); }

/// Appends some of a stream's values to another, or to itself.
void append_values(std::vector<float>& to, const std::vector<float>& from, std::size_t begin, std::size_t count) {
  const std::size_t size = to.size();
  to.resize(size + count);
  std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(begin), count, to.begin() + static_cast<std::ptrdiff_t>(size));
}

bool faces(const float* normals, const Vec3d& outside) {
  Vec3d sum(0, 0, 0);
  for (int corner = 0; corner < 3; ++corner) {
    sum += Vec3d(normals[3 * corner], normals[3 * corner + 1], normals[3 * corner + 2]);
  }
  return sum.dot(outside) > 0;
}

}  // namespace

AttributeStream& stream_for(AttributeStreams& streams, const AttributeKind& kind, int set) {
  assert(kind.components <= kMostComponents);
  AttributeStream fresh{kind, set, {}};
  const auto place = std::lower_bound(streams.begin(), streams.end(), fresh, comes_before);
  const bool known = place != streams.end() && place->kind == kind && place->set == set;
  return known ? *place : *streams.insert(place, std::move(fresh));
}

AttributeStreams empty_like(const AttributeStreams& streams) {
  AttributeStreams empty;
  for (const AttributeStream& stream : streams) empty.push_back({stream.kind, stream.set, {}});
  return empty;
}

std::string label_of(const AttributeStream& stream) {
  const std::string label(stream.kind.label);
  return stream.set == 0 ? label : label + " " + std::to_string(stream.set);
}

bool all_unit(const AttributeStream& stream, std::span<const float> values) {
  const std::size_t width = width_of(stream);
  for (std::size_t i = 0; i < values.size(); i += width) {
    double squares = 0;
    for (std::size_t c = 0; c < width; ++c) squares += static_cast<double>(values[i + c]) * values[i + c];
    if (!(std::abs(std::sqrt(squares) - 1) < 1e-4)) return false;
  }
  return true;
}

std::int64_t append_fitted(AttributeStream& to, std::span<const float> values, const NormalTransform& transform) {
  const std::size_t begin = to.values.size();
  to.values.insert(to.values.end(), values.begin(), values.end());
  std::int64_t repaired = 0;
  for (std::size_t i = begin; i < to.values.size(); i += width_of(to)) {
    float* value = &to.values[i];
    repaired += !fit(to.kind, value);
    move(to.kind, transform, value);
    for (std::size_t c = 0; c < width_of(to); ++c) value[c] += 0.0F;
  }
  return repaired;
}

void fill_up(AttributeStream& stream, std::size_t count) {
  stream.values.resize(count * width_of(stream), stream.kind.neutral);
}

void interpolate(const AttributeStream& stream, std::span<const WeightedElement> elements, float* value) {
  switch (stream.kind.interpolation) {
    case Interpolation::kLinear:
      return interpolate_linear(stream, elements, value);
    case Interpolation::kDirection:
      return interpolate_direction(stream, elements, value);
    case Interpolation::kJointsAndWeights:
      return interpolate_joints(stream, elements, value);
    case Interpolation::kNearest:
      return interpolate_nearest(stream, elements, value);
  }
}

AttributeStreams interpolated(const AttributeStreams& streams, std::span<const WeightedElement> elements) {
  AttributeStreams made = empty_like(streams);
  for (std::size_t s = 0; s < streams.size(); ++s) {
    made[s].values.resize(width_of(made[s]));
    interpolate(streams[s], elements, made[s].values.data());
  }
  return made;
}

void append_element(AttributeStreams& to, const AttributeStreams& from, std::size_t element) {
  assert(to.size() == from.size());
  for (std::size_t s = 0; s < to.size(); ++s) {
    const std::size_t width = width_of(to[s]);
    append_values(to[s].values, from[s].values, width * element, width);
  }
}

void join(AttributeStreams& to, std::size_t count, const AttributeStreams& from, std::size_t from_count) {
  for (const AttributeStream& stream : from) {
    AttributeStream& joined = stream_for(to, stream.kind, stream.set);
    fill_up(joined, count);
    joined.values.insert(joined.values.end(), stream.values.begin(), stream.values.end());
  }
  for (AttributeStream& stream : to) fill_up(stream, count + from_count);
}

void append_triangle(AttributeStreams& to, const AttributeStreams& from, TriangleId t) {
  assert(to.size() == from.size());
  for (std::size_t s = 0; s < to.size(); ++s) {
    const std::size_t width = triangle_width(to[s]);
    append_values(to[s].values, from[s].values, width * static_cast<std::size_t>(t), width);
  }
}

void reorder_triangles(AttributeStreams& corners, std::span<const TriangleId> order) {
  for (AttributeStream& stream : corners) stream.values = gathered(stream.values, triangle_width(stream), order);
}

void keep_triangles(AttributeStreams& corners, const std::vector<bool>& keep) {
  for (AttributeStream& stream : corners) {
    const std::size_t width = triangle_width(stream);
    std::size_t kept = 0;
    for (std::size_t t = 0; t < keep.size(); ++t) {
      if (!keep[t]) continue;
      if (kept != t) std::copy_n(&stream.values[width * t], width, &stream.values[width * kept]);
      ++kept;
    }
    stream.values.resize(width * kept);
  }
}

void halve_triangle(AttributeStreams& corners, std::size_t corner, double share) {
  const std::size_t first = corner - corner % 3;
  const std::size_t next = first + (corner + 1) % 3;
  const std::size_t previous = first + (corner + 2) % 3;
  const std::array<WeightedElement, 2> ends{{{corner, 1 - share}, {next, share}}};
  for (AttributeStream& stream : corners) {
    std::array<float, kMostComponents> middle;
    interpolate(stream, ends, middle.data());
    const std::size_t width = width_of(stream);
    stream.values.insert(stream.values.end(), middle.begin(), middle.begin() + stream.kind.components);
    append_values(stream.values, stream.values, width * next, width);
    append_values(stream.values, stream.values, width * previous, width);
    std::copy_n(middle.begin(), width, stream.at(next));
  }
}

void turn_triangle(AttributeStreams& corners, TriangleId t, const Vec3d& outside) {
  const std::size_t first = 3 * static_cast<std::size_t>(t);
  for (AttributeStream& stream : corners) {
    float* values = stream.at(first);
    if (stream.kind.movement == Movement::kNormal && faces(values, outside)) {
      for (std::size_t i = 0; i < triangle_width(stream); ++i) values[i] = 0.0F - values[i];
    }
    std::swap_ranges(stream.at(first + 1), stream.at(first + 1) + width_of(stream), stream.at(first + 2));
  }
}

}  // namespace lozenge
