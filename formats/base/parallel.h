// Loops over numbers, on all threads where that is worth it: the only way in which anything here runs in parallel. What
// a loop does must not depend on the order, so that results are the same on any number of threads: each number writes
// to places of its own, and sums are taken in the order of the numbers.
//
// Where the work throws, every number below the one that threw is done, and the error of the lowest is thrown.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string_view>
#include <type_traits>
#include <vector>

#include "formats/base/progress.h"

namespace lozenge {

/// Runs `work(i)` for every i below `count`; `threads` says whether it is much work.
void for_each_index(std::size_t count, bool threads, const std::function<void(std::size_t)>& work);

/// Runs `work(i)` for every i below `count` on all threads, and tells `progress` how much of `what` is done.
void for_each_index(std::size_t count, const Progress& progress, std::string_view what,
                    const std::function<void(std::size_t)>& work);

/// How many numbers a part has, but the last one.
inline constexpr std::size_t kPart = 2048;

/// Runs `work(begin, end)` over consecutive parts of what is below `count`. A part is for one thread: what its numbers
/// share, such as memory to work in, is made once a part.
/// \param part  numbers in each but the last; fewer than usual where each is much work
void for_each_part(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work,
                   std::size_t part = kPart);

/// The sum of what `part(begin, end)` gives for consecutive parts; the same on any number of threads.
template <typename Part>
auto sum_of_parts(std::size_t count, const Part& part) {
  using Sum = std::invoke_result_t<Part, std::size_t, std::size_t>;
  std::vector<Sum> sums((count + kPart - 1) / kPart);
  for_each_part(count, [&](std::size_t begin, std::size_t end) { sums[begin / kPart] = part(begin, end); });
  return std::accumulate(sums.begin(), sums.end(), Sum{});
}

/// How many threads the loops have at most: to be asked by work that would take memory for each.
int most_threads();

/// The number of this thread among those of the loop that it works for, below `most_threads()`.
int this_thread();

/// Memory to work in, one for each thread of the loops that begin while it lives. What an index leaves in it, the next
/// one finds: it must be of no consequence.
template <typename Memory>
class PerThread {
 public:
  Memory& local() { return memory_[static_cast<std::size_t>(this_thread())]; }

 private:
  std::vector<Memory> memory_ = std::vector<Memory>(static_cast<std::size_t>(most_threads()));
};

/// Runs `work` so that the loops of other people's libraries in it, too, have no thread but this one.
void on_this_thread(const std::function<void()>& work);

/// Sorts values, each part on a thread of its own, and merges the parts two by two.
/// \pre  values that are equal are the same: so there is one result
template <typename Value>
void sort_on_all_threads(std::vector<Value>& values) {
  std::size_t parts = 1;
  while (parts < static_cast<std::size_t>(most_threads()) && values.size() / (2 * parts) >= kPart) parts *= 2;
  const auto start = [&](std::size_t n) {
    return values.begin() + static_cast<std::ptrdiff_t>(values.size() * n / parts);
  };
  for_each_index(parts, parts > 1, [&](std::size_t n) { std::sort(start(n), start(n + 1)); });
  for (std::size_t merged = 2; merged <= parts; merged *= 2) {
    for_each_index(parts / merged, parts > merged, [&](std::size_t n) {
      std::inplace_merge(start(n * merged), start(n * merged + merged / 2), start((n + 1) * merged));
    });
  }
}

}  // namespace lozenge
