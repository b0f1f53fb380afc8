#include "formats/base/memory_budget.h"

#include <fmt/format.h>

#include <limits>

#include "formats/base/error.h"

namespace lozenge {

std::string readable_bytes(std::uint64_t bytes) {
  if (bytes < 1'000'000) return fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3);
  if (bytes < 1'000'000'000) return fmt::format("{:.0f} MB", static_cast<double>(bytes) / 1e6);
  return fmt::format("{:.1f} GB", static_cast<double>(bytes) / 1e9);
}

void require_memory(std::uint64_t bytes, std::uint64_t limit, const std::string& what) {
  if (limit == 0 || bytes <= limit) return;
  throw Error(ExitCode::kLimit, fmt::format("{} takes about {} of memory, the limit is {}; use a smaller input, or "
                                            "raise --max-memory",
                                            what, readable_bytes(bytes), readable_bytes(limit)));
}

void MemoryBudget::take(std::uint64_t bytes, const std::string& what) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  taken_ = bytes > kMost - taken_ ? kMost : taken_ + bytes;
  require_memory(taken_, limit_, what);
}

}  // namespace lozenge
