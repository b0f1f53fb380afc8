// A place beyond a border is walked inside one border at a time, the farthest first; names of places on borders are
// those of the samples there (patch_neighbours.h), as if texels were samples.
#include "formats/patches/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "formats/patches/patch_neighbours.h"

namespace lozenge {

namespace {

/// How far the place lies beyond each side; 0 on it, negative inside.
std::array<double, 4> excess(const AtlasPlace& p, double last) { return {-p.y, p.x - last, p.y - last, -p.x}; }

}  // namespace

Atlas::Atlas(const GeometryImage& image, const MapLayout& layout) : image_(image), layout_(layout) {
  for (std::int32_t patch = 0; patch < image.size(); ++patch) tiles_.push_back(layout.tile_of(patch));
}

AtlasPlace Atlas::place_at(double x, double y) const {
  // A texel reaches half a step to either side of its middle.
  const std::int32_t patch =
      layout_.patch_at(static_cast<std::int32_t>(std::floor(x + 0.5)), static_cast<std::int32_t>(std::floor(y + 0.5)));
  if (patch < 0 || patch >= image_.size()) return {};
  const MapTile& tile = tiles_[patch];
  return {patch, x - tile.x - tile.gutter, y - tile.y - tile.gutter};
}

std::size_t Atlas::texel_of(const AtlasPlace& place) const {
  const MapTile& tile = tiles_[place.patch];
  return static_cast<std::size_t>(tile.y + tile.gutter + static_cast<std::int32_t>(place.y)) * layout_.width +
         static_cast<std::size_t>(tile.x + tile.gutter + static_cast<std::int32_t>(place.x));
}

AtlasPlace Atlas::across(const AtlasPlace& p, std::int32_t side, double depth) const {
  const PatchSide other = image_.layout.adjacency[p.patch][side];
  if (other.patch < 0) return {};
  // Neighbouring sides run against each other, and have the same steps.
  const double last = this->last(p.patch);
  const std::array<double, 4> along{p.x, p.y, last - p.x, last - p.y};
  const double k = last - along[side];
  switch (other.side) {
    case 0:
      return {other.patch, k, depth};
    case 1:
      return {other.patch, last - depth, k};
    case 2:
      return {other.patch, last - k, last - depth};
    default:
      return {other.patch, depth, last - k};
  }
}

AtlasPlace Atlas::inside(AtlasPlace p) const {
  // The same in every patch that can be reached.
  const double last = this->last(p.patch);
  // Every step brings one of two coordinates inside; a few steps more are for gutters as wide as a patch.
  for (int step = 0; step < 8; ++step) {
    if (!exists(p)) std::swap(p.x, p.y);
    const std::array<double, 4> beyond = excess(p, last);
    const auto worst = std::max_element(beyond.begin(), beyond.end());
    if (*worst <= 0) break;
    const auto side = static_cast<std::int32_t>(worst - beyond.begin());
    if (const AtlasPlace next = across(p, side, *worst); next.patch >= 0) p = next;
    else if (side % 2 == 0) p.y = std::clamp(p.y, 0.0, last);
    else p.x = std::clamp(p.x, 0.0, last);
  }
  p.x = std::clamp(p.x, 0.0, last);
  p.y = std::clamp(p.y, 0.0, last);
  if (!exists(p)) std::swap(p.x, p.y);
  return p;
}

Vec2d Atlas::nearest_of_own_patch(const AtlasPlace& place) const {
  const double last = this->last(place.patch);
  const AtlasPlace clamped{place.patch, std::clamp(place.x, 0.0, last), std::clamp(place.y, 0.0, last)};
  if (exists(clamped)) return {clamped.x, clamped.y};
  const double on_boundary = (clamped.x + clamped.y) / 2;
  return {on_boundary, on_boundary};
}

AtlasPlace Atlas::first_name(const AtlasPlace& place) const {
  const std::array<double, 4> beyond = excess(place, last(place.patch));
  if (std::find(beyond.begin(), beyond.end(), 0.0) == beyond.end()) return place;
  const PatchNeighbours neighbours(tiles_[place.patch].inner(), image_.layout.adjacency);
  const PatchSample sample{place.patch, static_cast<std::int32_t>(place.x), static_cast<std::int32_t>(place.y)};
  const std::vector<PatchSample> names = neighbours.names(sample);
  const PatchSample& first = *std::min_element(names.begin(), names.end(), [](const auto& a, const auto& b) {
    return std::tie(a.patch, a.j, a.i) < std::tie(b.patch, b.j, b.i);
  });
  return {first.patch, static_cast<double>(first.i), static_cast<double>(first.j)};
}

}  // namespace lozenge
