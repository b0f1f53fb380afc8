// Loops over numbers, on all threads where that is worth it. What a loop does must not depend on the order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <type_traits>
#include <vector>

namespace lozenge {

/// Runs `work(i)` for every i below `count`; `threads` says whether it is much work.
void for_each_index(std::size_t count, bool threads, const std::function<void(std::size_t)>& work);

/// Runs `work(begin, end)` over consecutive parts of what is below `count`.
void for_each_part(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

/// How many numbers a part has, but the last one.
inline constexpr std::size_t kPart = 2048;

/// The sum of what `part(begin, end)` gives for consecutive parts; the same on any number of threads.
template <typename Part>
auto sum_of_parts(std::size_t count, const Part& part) {
  using Sum = std::invoke_result_t<Part, std::size_t, std::size_t>;
  std::vector<Sum> sums((count + kPart - 1) / kPart);
  for_each_part(count, [&](std::size_t begin, std::size_t end) { sums[begin / kPart] = part(begin, end); });
  return std::accumulate(sums.begin(), sums.end(), Sum{});
}

}  // namespace lozenge
