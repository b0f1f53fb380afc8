// Each level is made of the map itself, not of the level before: what a texel is the mean of is then all that counts.
// Tiles whose gutters are wide enough for a level are filtered by themselves, and then their corners are made to agree;
// of the others texels are the means of what patches hold.
#include "formats/patches/surface_mips.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "formats/base/parallel.h"
#include "formats/patches/patch_neighbours.h"

namespace lozenge {

namespace {

/// A sum of texels, and what it makes of them.
class Mean {
 public:
  explicit Mean(const BakedMap& map)
      : channels_(map.channels),
        covers_(map.channels == 4),
        directions_(traits_of(map.kind).values == MapValues::kDirections) {}

  bool empty() const { return !(weight_ > 0); }

  void add(const float* texel, double weight) {
    if (empty()) first_ = texel;
    const double cover = covers_ ? weight * texel[3] : weight;
    for (std::int32_t c = 0; c < channels_; ++c) {
      plain_[c] += weight * texel[c];
      covering_[c] += cover * texel[c];
    }
    weight_ += weight;
    cover_ += cover;
  }

  /// \pre not empty
  void store(float* texel) const {
    std::array<double, 4> value{};
    for (std::int32_t c = 0; c < channels_; ++c) value[c] = plain_[c] / weight_;
    for (std::int32_t c = 0; covers_ && cover_ > 0 && c < 3; ++c) value[c] = covering_[c] / cover_;
    const double length = std::sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
    for (std::int32_t c = 0; c < channels_; ++c) {
      // Nothing is left of opposite directions: then the first of them stands for all.
      if (directions_) value[c] = length > 0 ? value[c] / length : first_[c];
      texel[c] = static_cast<float>(value[c] + 0.0);
    }
  }

 private:
  std::int32_t channels_;
  bool covers_;
  bool directions_;
  const float* first_ = nullptr;
  std::array<double, 4> plain_{};
  std::array<double, 4> covering_{};
  double weight_ = 0;
  double cover_ = 0;
};

class Chain {
 public:
  Chain(const BakedMap& map, const PatchLayout& patches)
      : map_(map), patches_(patches), neighbours_(map.layout.tile, patches.adjacency), all_(map) {
    for (std::int32_t p = 0; p < patches.size(); ++p) tiles_.push_back(map.layout.tile_of(p));
    find_surface();
  }

  MipLevel level(std::int32_t number) const {
    MipLevel made{std::max(map_.width() >> number, 1), std::max(map_.height() >> number, 1), {}};
    made.texels.resize(static_cast<std::size_t>(made.width) * made.height * map_.channels);
    fill_coarsely(made);
    for_each_index(tiles_.size(), true, [&](std::size_t patch) {
      if (is_by_itself(number, static_cast<std::int32_t>(patch))) fill_tile(made, number, tiles_[patch]);
    });
    // What a map says in the frames of patches can't be compared.
    if (traits_of(map_.kind).frames == Frames::kNone) join_corners(made, number);
    return made;
  }

 private:
  const float* texel_at(std::int32_t x, std::int32_t y) const {
    return &map_.texels[(static_cast<std::size_t>(y) * map_.width() + x) * map_.channels];
  }
  float* texel_of(MipLevel& level, std::int32_t x, std::int32_t y) const {
    return &level.texels[(static_cast<std::size_t>(y) * level.width + x) * map_.channels];
  }

  /// Which texels show a patch: those whose middle lies in it, not in its gutter.
  void find_surface() {
    surface_.assign(static_cast<std::size_t>(map_.width()) * map_.height(), 0);
    for (std::size_t p = 0; p < tiles_.size(); ++p) {
      const MapTile& tile = tiles_[p];
      const bool half = !patches_.places[p].right.exists();
      const std::int32_t before = std::max(2 * tile.gutter + map_.shrink - 1, 0) / (2 * map_.shrink);
      const std::int32_t side = tile.size / map_.shrink;
      for (std::int32_t j = before; j < side - before; ++j) {
        for (std::int32_t i = before; i < (half ? j + 1 : side - before); ++i) {
          const std::int32_t x = tile.x / map_.shrink + i;
          const std::int32_t y = tile.y / map_.shrink + j;
          surface_[static_cast<std::size_t>(y) * map_.width() + x] = 1;
          all_.add(texel_at(x, y), 1);
        }
      }
    }
  }

  /// The mean of what patches hold of each texel's part of the map.
  void fill_coarsely(MipLevel& level) const {
    for_each_index(static_cast<std::size_t>(level.height), true, [&](std::size_t row) {
      const auto y = static_cast<std::int64_t>(row);
      for (std::int64_t x = 0; x < level.width; ++x) {
        Mean mean(map_);
        const auto left = static_cast<std::int32_t>(x * map_.width() / level.width);
        const auto right = static_cast<std::int32_t>(((x + 1) * map_.width() + level.width - 1) / level.width);
        const auto top = static_cast<std::int32_t>(y * map_.height() / level.height);
        const auto bottom = static_cast<std::int32_t>(((y + 1) * map_.height() + level.height - 1) / level.height);
        for (std::int32_t j = top; j < bottom; ++j) {
          for (std::int32_t i = left; i < right; ++i) {
            if (surface_[static_cast<std::size_t>(j) * map_.width() + i] != 0) mean.add(texel_at(i, j), 1);
          }
        }
        float* texel = texel_of(level, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y));
        if (!mean.empty()) mean.store(texel);
        else if (!all_.empty()) all_.store(texel);
      }
    });
  }

  bool is_by_itself(std::int32_t number, std::int32_t patch) const {
    return map_.layout.keeps_apart(tiles_[patch].size, map_.shrink << number);
  }

  void fill_tile(MipLevel& level, std::int32_t number, const MapTile& tile) const {
    const std::int32_t side = 1 << number;
    const std::int32_t texels = tile.size / map_.shrink / side;
    for (std::int32_t j = 0; j < texels; ++j) {
      for (std::int32_t i = 0; i < texels; ++i) {
        const std::int32_t left = tile.x / map_.shrink + i * side;
        const std::int32_t top = tile.y / map_.shrink + j * side;
        Mean mean(map_);
        for (std::int32_t y = top; y < top + side; ++y) {
          for (std::int32_t x = left; x < left + side; ++x) mean.add(texel_at(x, y), 1);
        }
        mean.store(texel_of(level, left / side, top / side));
      }
    }
  }

  /// The four texels of a level that a look-up at a corner of a patch blends, and the outermost of them: it shows what
  /// lies beyond both sides that meet there, and no look-up farther than a texel from the corner has a use for it.
  struct CornerTexels {
    std::array<float*, 4> texels{};
    std::array<double, 4> weights{};
    std::size_t outermost = 0;
  };
  CornerTexels corner_texels(MipLevel& level, std::int32_t number, std::int32_t patch, std::int32_t corner) const {
    const MapTile& tile = tiles_[patch];
    const double side = map_.shrink << number;
    const double before = tile.gutter + 0.5;
    const double x = (tile.x + (corner == 0 || corner == 3 ? before : tile.size - before)) / side - 0.5;
    const double y = (tile.y + (corner < 2 ? before : tile.size - before)) / side - 0.5;
    const auto i = static_cast<std::int32_t>(std::floor(x));
    const auto j = static_cast<std::int32_t>(std::floor(y));
    const double s = x - i;
    const double t = y - j;
    return {
        {texel_of(level, i, j), texel_of(level, i + 1, j), texel_of(level, i, j + 1), texel_of(level, i + 1, j + 1)},
        {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t},
        std::array<std::size_t, 4>{0, 1, 3, 2}[static_cast<std::size_t>(corner)]};
  }

  void join_corners(MipLevel& level, std::int32_t number) const {
    for (std::int32_t p = 0; p < patches_.size(); ++p) {
      if (!is_by_itself(number, p)) continue;
      for (std::int32_t corner = 0; corner < 4; ++corner) {
        if (corner == 1 && neighbours_.is_half(p)) continue;
        const std::vector<PatchCorner> around = neighbours_.around({p, corner});
        const auto is_before = [&](const PatchCorner& c) { return c.patch < p || (c.patch == p && c.corner < corner); };
        if (std::none_of(around.begin(), around.end(), is_before)) join_corner(level, number, around);
      }
    }
  }

  /// Look-ups from all patches around a corner become their mean. On a border, they are as they were from the next
  /// texel on, where both sides have the same; in between they are a line.
  void join_corner(MipLevel& level, std::int32_t number, const std::vector<PatchCorner>& around) const {
    std::vector<std::array<double, 4>> seen;
    std::array<double, 4> mean{};
    for (const PatchCorner& c : around) {
      const CornerTexels at = corner_texels(level, number, c.patch, c.corner);
      std::array<double, 4> value{};
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::int32_t ch = 0; ch < map_.channels; ++ch) value[ch] += at.weights[k] * at.texels[k][ch];
      }
      for (std::size_t ch = 0; ch < 4; ++ch) mean[ch] += value[ch] / static_cast<double>(around.size());
      seen.push_back(value);
    }
    for (std::size_t n = 0; n < around.size(); ++n) {
      const auto move = [&](std::int32_t corner) {
        const CornerTexels at = corner_texels(level, number, around[n].patch, corner);
        float* texel = at.texels[at.outermost];
        for (std::int32_t ch = 0; ch < map_.channels; ++ch) {
          texel[ch] = in_range(texel[ch] + (mean[ch] - seen[n][ch]) / at.weights[at.outermost]);
        }
        renew_direction(texel);
      };
      move(around[n].corner);
      // Beyond the diagonal a half patch is mirrored.
      if (around[n].corner == 3 && neighbours_.is_half(around[n].patch)) move(1);
    }
  }

  float in_range(double value) const {
    const NumberRange range = range_of(traits_of(map_.kind).values);
    return static_cast<float>(std::clamp(value, double{range.least}, double{range.most}) + 0.0);
  }

  void renew_direction(float* texel) const {
    if (traits_of(map_.kind).values != MapValues::kDirections) return;
    const double length = std::hypot(double{texel[0]}, double{texel[1]}, double{texel[2]});
    for (std::size_t c = 0; length > 0 && c < 3; ++c) texel[c] = static_cast<float>(texel[c] / length + 0.0);
  }

  const BakedMap& map_;
  const PatchLayout& patches_;
  PatchNeighbours neighbours_;
  std::vector<MapTile> tiles_;
  std::vector<std::uint8_t> surface_;  ///< [texel]
  Mean all_;
};

}  // namespace

std::int32_t mip_count(const BakedMap& map) {
  return static_cast<std::int32_t>(std::bit_width(static_cast<std::uint32_t>(std::max(map.width(), map.height()))));
}

std::vector<MipLevel> surface_mips(const BakedMap& map, const PatchLayout& patches) {
  const Chain chain(map, patches);
  std::vector<MipLevel> levels;
  for (std::int32_t number = 1; number < mip_count(map); ++number) levels.push_back(chain.level(number));
  return levels;
}

}  // namespace lozenge
