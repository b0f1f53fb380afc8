// Loops over numbers, on all threads where that is worth it. What a loop does must not depend on the order.
#pragma once

#include <cstddef>
#include <functional>

namespace lozenge {

/// Runs `work(i)` for every i below `count`; `threads` says whether it is much work.
void for_each_index(std::size_t count, bool threads, const std::function<void(std::size_t)>& work);

/// Runs `work(begin, end)` over consecutive parts of what is below `count`.
void for_each_part(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work);

/// The sum of what `part(begin, end)` gives for consecutive parts; the same on any number of threads.
double sum_of_parts(std::size_t count, const std::function<double(std::size_t, std::size_t)>& part);

}  // namespace lozenge
