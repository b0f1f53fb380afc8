#include "formats/files/map_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <system_error>

namespace lozenge {

namespace {

/// More tiles of one size are no texture.
constexpr std::int32_t kMostTiles = 1 << 26;

constexpr std::string_view kYDown = " normal-y=down";
constexpr std::string_view kOrder = " order=";

/// The number after " key=", if it is a whole number from `least` to `most`.
std::optional<std::int32_t> field(std::string_view text, std::string_view key, std::int32_t least, std::int32_t most) {
  const std::string pattern = fmt::format(" {}=", key);
  const std::size_t at = text.find(pattern);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = text.substr(at + pattern.size());
  std::int32_t value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  const bool whole = error == std::errc() && (end == rest.data() + rest.size() || *end == ' ');
  return whole && value >= least && value <= most ? std::optional(value) : std::nullopt;
}

/// How many tiles of each size the description tells of; one that tells of none is of the format's first version, with
/// as many of one size as fit. Nothing where that makes no sense.
std::optional<std::array<std::int32_t, kMostFirstLevel + 1>> counts_in(std::string_view text, std::int64_t cells) {
  std::array<std::int32_t, kMostFirstLevel + 1> counts{};
  if (text.find(" tiles0=") == std::string_view::npos) {
    if (cells > kMostTiles) return std::nullopt;
    counts[0] = static_cast<std::int32_t>(cells);
    return counts;
  }
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto count = field(text, fmt::format("tiles{}", k), 0, kMostTiles);
    if (!count) return std::nullopt;
    counts[k] = *count;
  }
  return counts;
}

/// Four numbers, as "0.5/0.25/1/1", in the range of the kind. Nothing where they aren't.
std::optional<std::array<float, 4>> four_numbers(std::string_view text, const NumberRange& range) {
  std::array<float, 4> values{};
  for (std::size_t c = 0; c < values.size(); ++c) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[c]);
    if (error != std::errc() || !(values[c] >= range.least && values[c] <= range.most)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    const bool is_last = c + 1 == values.size();
    if (is_last) break;
    if (!text.starts_with('/')) return std::nullopt;
    text.remove_prefix(1);
  }
  const bool ends = text.empty() || text.front() == ' ';
  return ends ? std::optional(values) : std::nullopt;
}

/// What the description says is the same everywhere; nothing where that makes no sense.
std::optional<std::vector<ConstantMap>> constants_in(std::string_view text) {
  std::vector<ConstantMap> constants;
  for (const MapTraits& traits : kMapKinds) {
    const std::string pattern = fmt::format(" constant-{}=", traits.name);
    const std::size_t at = text.find(pattern);
    if (at == std::string_view::npos) continue;
    const auto value = four_numbers(text.substr(at + pattern.size()), range_of(traits.values));
    if (!value) return std::nullopt;
    constants.push_back({traits.kind, *value});
  }
  return constants;
}

/// The order of tiles that the description tells of; none is given where it tells of none. Nothing where that makes no
/// sense: each patch has a tile of its own, of its size.
std::optional<TileOrder> order_in(std::string_view text, const std::array<std::int32_t, kMostFirstLevel + 1>& counts) {
  const std::size_t at = text.find(kOrder);
  if (at == std::string_view::npos) return TileOrder();
  text.remove_prefix(at + kOrder.size());
  std::vector<std::int32_t> tiles;
  std::int32_t first = 0;
  for (const std::int32_t count : counts) {
    std::vector<bool> taken;
    for (std::int32_t n = 0; n < count; ++n) {
      std::int32_t tile = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), tile);
      if (error != std::errc() || tile < first || tile >= first + count) return std::nullopt;
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
      if (text.starts_with(',')) text.remove_prefix(1);
      taken.resize(static_cast<std::size_t>(count), false);
      if (taken[static_cast<std::size_t>(tile - first)]) return std::nullopt;
      taken[static_cast<std::size_t>(tile - first)] = true;
      tiles.push_back(tile);
    }
    first += count;
  }
  return TileOrder(std::move(tiles));
}

/// Tiles lie inside of the texture, and halve as often as the smallest of them asks for.
bool is_sound(const MapLayout& layout) {
  if (layout.patches() < 1 || layout.rows() < 1) return false;
  const std::int32_t smallest = layout.smallest_tile();
  return smallest >= 1 && layout.tile % smallest == 0 &&
         std::has_single_bit(static_cast<std::uint32_t>(layout.tile / smallest)) &&
         smallest - 2 * layout.gutter_of(smallest) >= 2 && std::int64_t{layout.columns} * layout.tile <= layout.width &&
         std::int64_t{layout.rows()} * layout.tile <= layout.height;
}

}  // namespace

std::string map_description(const BakedMap& map, NormalY normal_y) {
  const MapLayout& layout = map.layout;
  std::string text =
      fmt::format("lozenge {} columns={} rows={} tile={} gutter={} shrink={} level={}", traits_of(map.kind).name,
                  layout.columns, layout.rows(), layout.tile, layout.gutter, map.shrink, map.level);
  for (std::size_t k = 0; k < layout.counts.size(); ++k) text += fmt::format(" tiles{}={}", k, layout.counts[k]);
  if (layout.order.is_given()) text += fmt::format("{}{}", kOrder, fmt::join(layout.order.tiles(), ","));
  for (const ConstantMap& constant : map.constants) {
    text += fmt::format(" constant-{}={}", traits_of(constant.kind).name, fmt::join(constant.value, "/"));
  }
  if (normal_y == NormalY::kDown && holds_tangent_space_normals(traits_of(map.kind))) text += kYDown;
  return text;
}

NormalY described_normal_y(std::string_view text) {
  return text.find(kYDown) == std::string_view::npos ? NormalY::kUp : NormalY::kDown;
}

std::optional<BakedMap> described_map(std::string_view text, std::int32_t width, std::int32_t height) {
  BakedMap map;
  const auto traits = std::find_if(kMapKinds.begin(), kMapKinds.end(), [&](const MapTraits& t) {
    return text.substr(0, text.find(" columns=")) == fmt::format("lozenge {}", t.name);
  });
  if (traits == kMapKinds.end()) return std::nullopt;
  const auto columns = field(text, "columns", 1, kMostMapSize);
  const auto rows = field(text, "rows", 1, kMostMapSize);
  const auto tile = field(text, "tile", 1, kMostMapSize);
  const auto gutter = field(text, "gutter", 0, kMostMapSize);
  const auto shrink = field(text, "shrink", 1, kMostMapSize);
  const auto level = field(text, "level", 0, 31);
  if (!columns || !rows || !tile || !gutter || !shrink || !level) return std::nullopt;
  const std::int64_t whole_width = std::int64_t{width} * *shrink;
  const std::int64_t whole_height = std::int64_t{height} * *shrink;
  const auto counts = counts_in(text, std::int64_t{*columns} * *rows);
  if (!counts || whole_width > kMostMapSize || whole_height > kMostMapSize) return std::nullopt;
  map.layout = {static_cast<std::int32_t>(whole_width),
                static_cast<std::int32_t>(whole_height),
                *columns,
                *tile,
                *gutter,
                *counts,
                {}};
  if (!is_sound(map.layout) || map.layout.rows() != *rows) return std::nullopt;
  auto order = order_in(text, *counts);
  if (!order) return std::nullopt;
  map.layout.order = *std::move(order);
  const auto constants = constants_in(text);
  if (!constants) return std::nullopt;
  map.constants = *constants;
  map.kind = traits->kind;
  map.channels = traits->channels;
  map.shrink = *shrink;
  map.level = *level;
  return map;
}

}  // namespace lozenge
