// Keeps places apart that rounding made equal.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "formats/base/vector.h"

namespace lozenge {

/// A place by its position and whatever number it goes by; ordered by both.
struct NumberedPosition {
  std::array<std::uint32_t, 3> bits;
  std::int32_t number = 0;

  auto operator<=>(const NumberedPosition&) const = default;
};
NumberedPosition numbered(const Vec3f& position, std::int32_t number);

struct MovedPosition {
  std::int32_t number = 0;
  Vec3f position;
};

/// Readers weld what has equal bits, so different places must differ. Of equal ones all but the first are moved to the
/// nearest free positions, by the smallest steps that make them differ. \param places  sorted
std::vector<MovedPosition> moved_apart(const std::vector<NumberedPosition>& places);

/// The same of all of these, in place. \return how many were moved
std::int64_t make_distinct(std::vector<Vec3f>& positions);

}  // namespace lozenge
