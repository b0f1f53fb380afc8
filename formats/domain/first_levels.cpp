#include "formats/domain/first_levels.h"

#include <fmt/format.h>

namespace lozenge {

std::optional<std::string> find_first_level_defect(std::span<const std::int32_t> levels, std::size_t count,
                                                   std::int32_t most, std::string_view one,
                                                   const std::vector<std::array<std::int32_t, 2>>& touching) {
  if (levels.empty()) return std::nullopt;
  if (levels.size() != count)
    return fmt::format("there are {} first levels, one is due for each {}: {}", levels.size(), one, count);
  for (std::size_t n = 0; n < levels.size(); ++n) {
    if (levels[n] < 0 || levels[n] > most) {
      return fmt::format("the first level {} of {} {} is not 0 to {}", levels[n], one, n, most);
    }
    if (n > 0 && levels[n] < levels[n - 1]) {
      return fmt::format("first levels fall from {} to {} at {} {}", levels[n - 1], levels[n], one, n);
    }
  }
  for (const auto& [a, b] : touching) {
    if (levels[a] == levels[b]) continue;
    return fmt::format("{0} {1} and {0} {2} touch, but have the first levels {3} and {4}", one, a, b, levels[a],
                       levels[b]);
  }
  return std::nullopt;
}

}  // namespace lozenge
