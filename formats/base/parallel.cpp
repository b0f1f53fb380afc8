#include "formats/base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace lozenge {

void for_each_index(std::size_t count, bool threads, const std::function<void(std::size_t)>& work) {
  if (!threads) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  // A thread that waits for this loop must not begin with something else: the scratch memory of what it is in the
  // middle of belongs to the thread.
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, work); });
}

void for_each_part(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  const std::size_t parts = (count + kPart - 1) / kPart;
  for_each_index(parts, parts > 1, [&](std::size_t i) { work(i * kPart, std::min(count, (i + 1) * kPart)); });
}

}  // namespace lozenge
