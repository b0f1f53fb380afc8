// Neighbours of a sample across the borders of its patch (paper, Sec. 6.0.1): all that a solver on the atlas needs.
//
// Header-only, and independent of how samples are stored: the functions need N and the adjacency table. A sample on a
// border has one name in each patch that holds it. Around an inner sample six neighbours lie in its own patch; around
// one on a side, two on the side, two in each patch; around a corner, as many as the patches there give. Where the
// surface ends, a patch without neighbours across its sides 0 and 1 exists for j >= i alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "formats/patches/patch_layout.h"

namespace lozenge {

/// Sample (i, j) of a patch, 0 <= i, j < N.
struct PatchSample {
  std::int32_t patch = -1;  ///< -1: no such sample, beyond the surface's boundary
  std::int32_t i = 0;
  std::int32_t j = 0;

  bool exists() const { return patch >= 0; }
  friend bool operator==(const PatchSample&, const PatchSample&) = default;
};

/// Corner c of a patch, where its side c starts: (0, 0), (N - 1, 0), (N - 1, N - 1), (0, N - 1).
struct PatchCorner {
  std::int32_t patch = -1;
  std::int32_t corner = -1;
  friend bool operator==(const PatchCorner&, const PatchCorner&) = default;
};

/// The samples around one, counter-clockwise.
struct SampleRing {
  std::vector<PatchSample> samples;
  bool closed = true;  ///< the last is a neighbour of the first; not so on the surface's boundary
};

/// The look-up. Keeps references to the adjacency table, [patch][side], which must be reciprocal, and the first levels.
class PatchNeighbours {
 public:
  /// Of grids with `samples` a side in every patch.
  PatchNeighbours(std::int32_t samples, const std::vector<std::array<PatchSide, 4>>& adjacency)
      : last_(samples - 1), adjacency_(adjacency) {}
  /// Of the grids that a level of detail draws.
  explicit PatchNeighbours(const PatchLayout& layout, std::int32_t level = 0)
      : last_(layout.samples - 1),
        level_(level),
        adjacency_(layout.adjacency),
        first_levels_(layout.first_levels.empty() ? nullptr : &layout.first_levels) {}

  /// The number of a patch's last sample along a side; patches that touch have the same.
  std::int32_t last(std::int32_t patch) const {
    return last_ >> (first_levels_ ? std::max(level_, (*first_levels_)[patch]) : level_);
  }

  /// Sample k of a side, 0 at the side's start, `depth` steps inside the patch.
  PatchSample on_side(PatchSide side, std::int32_t k, std::int32_t depth = 0) const {
    switch (side.side) {
      case 0:
        return {side.patch, k, depth};
      case 1:
        return {side.patch, last(side.patch) - depth, k};
      case 2:
        return {side.patch, last(side.patch) - k, last(side.patch) - depth};
      default:
        return {side.patch, depth, last(side.patch) - k};
    }
  }

  /// What lies across a side: at depth 0 the neighbour's name of our sample k, further on the samples of the neighbour
  /// `depth` steps from the border. Neighbouring sides run against each other.
  PatchSample across(PatchSide side, std::int32_t k, std::int32_t depth = 0) const {
    const PatchSide other = adjacency_[side.patch][side.side];
    return other.patch < 0 ? PatchSample{} : on_side(other, last(other.patch) - k, depth);
  }

  /// True where the patch exists for j >= i alone.
  bool is_half(std::int32_t patch) const { return adjacency_[patch][0].patch < 0; }

  bool exists(const PatchSample& s) const {
    const std::int32_t most = last(s.patch);
    return s.i >= 0 && s.j >= 0 && s.i <= most && s.j <= most && !(is_half(s.patch) && s.i > s.j);
  }

  PatchSample corner_sample(PatchCorner c) const { return on_side({c.patch, c.corner}, 0); }

  /// The corners of all patches that meet in this one, counter-clockwise, starting there; around a vertex on the
  /// surface's boundary from the clockwise end of its fan.
  std::vector<PatchCorner> around(PatchCorner corner) const {
    PatchCorner first = corner;
    for (PatchCorner c = clockwise(first); c.patch >= 0 && !(c == corner); c = clockwise(c)) first = c;
    if (clockwise(first) == corner) first = corner;
    std::vector<PatchCorner> found{first};
    for (PatchCorner c = counter_clockwise(first); c.patch >= 0 && !(c == first); c = counter_clockwise(c)) {
      found.push_back(c);
    }
    return found;
  }

  /// Every name of a sample, counter-clockwise around it; one alone inside a patch.
  std::vector<PatchSample> names(const PatchSample& s) const {
    const int side = side_of(s);
    if (side < 0) return {s};
    const std::int32_t k = place_on_side(s, side);
    if (k > 0) {
      const PatchSample other = across({s.patch, side}, k);
      return other.exists() ? std::vector<PatchSample>{s, other} : std::vector<PatchSample>{s};
    }
    std::vector<PatchSample> found;
    for (const PatchCorner c : around({s.patch, side})) found.push_back(corner_sample(c));
    return found;
  }

  /// The neighbours of a sample on the surface: the ends of the mesh edges around it. Each has one of its names.
  SampleRing ring(const PatchSample& s) const {
    SampleRing found;
    for (const PatchSample& name : names(s)) {
      const std::vector<PatchSample> sector = sector_around(name);
      // The last one of a sector is the first one of the next.
      if (!found.samples.empty() && !sector.empty()) found.samples.pop_back();
      found.samples.insert(found.samples.end(), sector.begin(), sector.end());
    }
    found.closed = !on_boundary(s);
    if (found.closed && side_of(s) >= 0) found.samples.pop_back();
    return found;
  }

  /// True on the boundary of the surface.
  bool on_boundary(const PatchSample& s) const {
    for (const PatchSample& name : names(s)) {
      if (is_half(name.patch) && name.i == name.j) return true;
    }
    return false;
  }

 private:
  PatchCorner counter_clockwise(PatchCorner c) const {
    const PatchSide next = adjacency_[c.patch][(c.corner + 3) % 4];
    return {next.patch, next.side};
  }
  PatchCorner clockwise(PatchCorner c) const {
    const PatchSide next = adjacency_[c.patch][c.corner];
    return next.patch < 0 ? PatchCorner{} : PatchCorner{next.patch, (next.side + 1) % 4};
  }

  /// The side that the sample lies on, a corner on the side that starts there; -1 inside.
  int side_of(const PatchSample& s) const {
    const std::int32_t most = last(s.patch);
    if (s.j == 0 && s.i < most) return 0;
    if (s.i == most && s.j < most) return 1;
    if (s.j == most && s.i > 0) return 2;
    return s.i == 0 ? 3 : -1;
  }
  std::int32_t place_on_side(const PatchSample& s, int side) const {
    const std::array<std::int32_t, 4> places{s.i, s.j, last(s.patch) - s.i, last(s.patch) - s.j};
    return places[side];
  }

  /// Neighbours inside the sample's own patch, counter-clockwise; on a border from one side to the other.
  std::vector<PatchSample> sector_around(const PatchSample& s) const {
    // The long diagonal is an edge only where a half patch ends on it.
    const bool cut = is_half(s.patch) && s.i == s.j;
    static constexpr std::array<std::array<std::int32_t, 2>, 8> kSteps{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    const int first = 2 * std::max(side_of(s), 0);  // the step along the side that we are on
    std::vector<PatchSample> found;
    for (int n = 0; n < 8; ++n) {
      const auto& [di, dj] = kSteps[(first + n) % 8];
      if (di == dj && !cut) continue;
      const PatchSample neighbour{s.patch, s.i + di, s.j + dj};
      if (exists(neighbour)) found.push_back(neighbour);
    }
    return found;
  }

  std::int32_t last_;
  std::int32_t level_ = 0;
  const std::vector<std::array<PatchSide, 4>>& adjacency_;
  const std::vector<std::int32_t>* first_levels_ = nullptr;  // [patch]; none: 0 everywhere
};

}  // namespace lozenge
