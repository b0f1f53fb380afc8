// One pass over the samples for each promise; the first place where one is broken is told, for one is enough to refuse
// a file.
#include "formats/patches/geometry_image_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/patches/patch_neighbours.h"

namespace lozenge {

namespace {

using Defect = std::optional<std::string>;

/// How far outside the bounds a sample may lie, in shares of their diagonal and their distance from the origin:
/// rounding, and the small steps that keep samples apart (stages/sample).
constexpr double kSlack = 1e-4;

/// Floats hold unit vectors to about 1e-7.
constexpr double kUnitSlack = 1e-5;

bool same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof(Vec3f)) == 0; }

bool same_influence(const float* a, const float* b) { return std::equal(a, a + kInfluences.components, b); }

std::string name(int level, const PatchSample& s) {
  return fmt::format("sample ({}, {}) of patch {}, level {}", s.i, s.j, s.patch, level);
}

/// The box that samples may lie in.
Bounds widened(const Bounds& bounds) {
  double reach = diagonal(bounds);
  for (int axis = 0; axis < 3; ++axis) {
    reach += std::max(std::abs(double{bounds.low[axis]}), std::abs(double{bounds.high[axis]}));
  }
  const auto slack = static_cast<float>(kSlack * reach);
  return {bounds.low - Vec3f(slack, slack, slack), bounds.high + Vec3f(slack, slack, slack)};
}

Defect find_value_defect(const Vec3f& position, const Vec3f& normal, const Bounds& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(position[axis]) || !std::isfinite(normal[axis])) return "is not finite";
    if (position[axis] < box.low[axis] || position[axis] > box.high[axis]) return "lies outside the bounds";
  }
  if (std::abs(Vec3d(normal).length() - 1) > kUnitSlack) return "has a normal that is no unit vector";
  return std::nullopt;
}

/// Calls `visit` for every sample of every patch that exists on a level, halves beyond the boundary included, until it
/// returns a defect.
template <typename Visit>
Defect for_each_sample(const GeometryImage& image, int level, Visit visit) {
  const std::int32_t samples = image.levels[level].samples;
  for (std::int32_t patch = 0; patch < image.layout.count_on(level); ++patch) {
    for (std::int32_t j = 0; j < samples; ++j) {
      for (std::int32_t i = 0; i < samples; ++i) {
        if (Defect defect = visit(PatchSample{patch, i, j})) return name(level, {patch, i, j}) + " " + *defect;
      }
    }
  }
  return std::nullopt;
}

Defect find_sample_defect(const GeometryImage& image, int level) {
  const GeometryLevel& of = image.levels[level];
  const PatchNeighbours neighbours(image.layout, level);
  const Bounds box = widened(image.layout.bounds);
  return for_each_sample(image, level, [&](const PatchSample& s) -> Defect {
    const std::size_t at = image.index(of, s.patch, s.i, s.j);
    if (neighbours.exists(s)) return find_value_defect(of.positions[at], of.normals[at], box);
    const Vec3f zero(0, 0, 0);
    if (same_bits(of.positions[at], zero) && same_bits(of.normals[at], zero)) return std::nullopt;
    return "lies beyond the surface's boundary, but is not zero";
  });
}

Defect find_empty_tile_defect(const GeometryImage& image, int level) {
  const GeometryLevel& of = image.levels[level];
  for (std::int32_t tile = image.layout.count_on(level); tile < image.columns * of.rows; ++tile) {
    for (std::int32_t j = 0; j < of.samples; ++j) {
      for (std::int32_t i = 0; i < of.samples; ++i) {
        const std::size_t at = image.index(of, tile, i, j);
        const Vec3f zero(0, 0, 0);
        if (!same_bits(of.positions[at], zero) || !same_bits(of.normals[at], zero)) {
          return fmt::format("tile {} of level {} belongs to no patch, but is not zero", tile, level);
        }
      }
    }
  }
  return std::nullopt;
}

/// Sides agree sample by sample, corners included. Around a corner that joins all patches there.
Defect find_border_defect(const GeometryImage& image) {
  const PatchNeighbours neighbours(image.layout);
  for (std::int32_t patch = 0; patch < image.size(); ++patch) {
    for (int side = 0; side < 4; ++side) {
      if (image.layout.adjacency[patch][side].patch < 0) continue;
      for (std::int32_t k = 0; k <= neighbours.last(patch); ++k) {
        const PatchSample here = neighbours.on_side({patch, side}, k);
        const PatchSample there = neighbours.across({patch, side}, k);
        if (same_bits(image.position(0, here.patch, here.i, here.j),
                      image.position(0, there.patch, there.i, there.j)) &&
            same_bits(image.normal(0, here.patch, here.i, here.j), image.normal(0, there.patch, there.i, there.j))) {
          continue;
        }
        const int level = image.layout.first_level(patch);
        return name(level, here) + " differs from the same sample in the neighbour: " + name(level, there);
      }
    }
  }
  return std::nullopt;
}

/// Marks of caps are 0 or 1, 0 where nothing is, and the same on both sides of a border.
Defect find_cap_defect(const GeometryImage& image, int level) {
  const GeometryLevel& of = image.levels[level];
  if (!image.has_caps()) return std::nullopt;
  if (of.caps.size() != of.positions.size()) return "there are not as many marks of caps as samples";
  const auto most = std::max_element(of.caps.begin(), of.caps.end());
  if (*most > 1)
    return fmt::format("texel {} of level {} marks a cap with {}, not 0 or 1", most - of.caps.begin(), level, *most);
  const PatchNeighbours neighbours(image.layout, level);
  return for_each_sample(image, level, [&](const PatchSample& s) -> Defect {
    const bool marked = image.on_cap(level, s.patch, s.i, s.j);
    if (!neighbours.exists(s))
      return marked ? Defect("lies beyond the surface's boundary, but on a cap") : std::nullopt;
    for (const PatchSample& other : neighbours.names(s)) {
      if (image.on_cap(level, other.patch, other.i, other.j) != marked) return "is on a cap in one patch alone";
    }
    return std::nullopt;
  });
}

/// Joints and weights are such, of what a skin places and nothing else, and the same on both sides of a border.
Defect find_influence_defect(const GeometryImage& image, int level) {
  if (!image.has_influences()) {
    return image.layout.bodies.has_skin() ? Defect("a body has a skin, but samples have no joints") : std::nullopt;
  }
  const GeometryLevel& of = image.levels[level];
  if (of.influences.size() != kInfluences.components * of.positions.size()) {
    return "there are not as many joints and weights as samples";
  }
  const PatchNeighbours neighbours(image.layout, level);
  return for_each_sample(image, level, [&](const PatchSample& s) -> Defect {
    const float* here = image.influence(level, s.patch, s.i, s.j);
    if (!is_influence(here)) return "has joints or weights that are none";
    if (!neighbours.exists(s)) return std::nullopt;
    const std::int32_t body = image.layout.bodies.owner_of(s.patch);
    const bool is_skinned = body >= 0 && image.layout.bodies.bodies[body].skin >= 0;
    if (is_skinned == is_unmoved(here)) return is_skinned ? "has no joint that moves it" : "has joints, but no skin";
    for (const PatchSample& other : neighbours.names(s)) {
      const float* there = image.influence(level, other.patch, other.i, other.j);
      if (!same_influence(here, there)) return "has other joints in one patch than in another";
    }
    return std::nullopt;
  });
}

Defect find_level_defect(const GeometryImage& image, int level) {
  const GeometryLevel& coarse = image.levels[level];
  return for_each_sample(image, level, [&](const PatchSample& s) -> Defect {
    const int first = image.layout.first_level(s.patch);
    const GeometryLevel& fine = image.levels[first];
    const int halvings = level - first;
    const std::size_t a = image.index(coarse, s.patch, s.i, s.j);
    const std::size_t b = image.index(fine, s.patch, s.i << halvings, s.j << halvings);
    if (same_bits(coarse.positions[a], fine.positions[b]) && same_bits(coarse.normals[a], fine.normals[b]) &&
        (!image.has_caps() || coarse.caps[a] == fine.caps[b]) &&
        (!image.has_influences() || same_influence(&coarse.influences[kInfluences.components * a],
                                                   &fine.influences[kInfluences.components * b]))) {
      return std::nullopt;
    }
    return fmt::format("differs from sample ({}, {}) of level {}", s.i << halvings, s.j << halvings, first);
  });
}

}  // namespace

std::optional<std::string> find_defect(const GeometryImage& image) {
  const int levels = static_cast<int>(image.levels.size());
  for (int level = 0; level < levels; ++level) {
    if (Defect defect = find_sample_defect(image, level)) return defect;
  }
  if (Defect defect = find_border_defect(image)) return defect;
  for (int level = 0; level < levels; ++level) {
    if (Defect defect = find_cap_defect(image, level)) return defect;
    if (Defect defect = find_influence_defect(image, level)) return defect;
    if (Defect defect = find_empty_tile_defect(image, level)) return defect;
    if (Defect defect = find_level_defect(image, level)) return defect;
  }
  return std::nullopt;
}

}  // namespace lozenge
