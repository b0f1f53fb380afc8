#include "formats/patches/map_kinds.h"

#include <algorithm>
#include <limits>

#include "formats/base/srgb.h"

namespace lozenge {

namespace {

constexpr bool in_order() {
  for (std::size_t k = 0; k < kMapKinds.size(); ++k) {
    if (kMapKinds[k].kind != static_cast<MapKind>(k)) return false;
  }
  return true;
}
static_assert(in_order());

bool is_srgb(const MapTraits& traits, std::int32_t channel) {
  return traits.colours == ColourSpace::kSrgb && channel < 3;
}

}  // namespace

NumberRange range_of(MapValues values) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  switch (values) {
    case MapValues::kDirections:
      return {-1, 1};
    case MapValues::kShares:
      return {0, 1};
    default:
      return {-kInfinity, kInfinity};
  }
}

double stored_share(const MapTraits& traits, std::int32_t channel, double value) {
  const double share = std::clamp(traits.values == MapValues::kDirections ? 0.5 * value + 0.5 : value, 0.0, 1.0);
  return is_srgb(traits, channel) ? srgb_of_linear(share) : share;
}

double value_of_share(const MapTraits& traits, std::int32_t channel, double share) {
  if (traits.values == MapValues::kDirections) return 2 * share - 1;
  return is_srgb(traits, channel) ? linear_of_srgb(share) : share;
}

}  // namespace lozenge
