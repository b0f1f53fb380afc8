// First levels, as domain triangles have them and as patches do: what makes sense of both is the same.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lozenge {

/// What is wrong with first levels that come from a file, in words, or nothing: there is one for each element (or none
/// at all), from 0 to `most`, they ascend, and elements that touch have the same.
/// \param count     of the elements
/// \param one       how messages call an element
/// \param touching  numbers of elements
std::optional<std::string> find_first_level_defect(std::span<const std::int32_t> levels, std::size_t count,
                                                   std::int32_t most, std::string_view one,
                                                   const std::vector<std::array<std::int32_t, 2>>& touching);

}  // namespace lozenge
