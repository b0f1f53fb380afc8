// oneTBB shares the numbers out. Two things are added: errors are collected, so that which one is told of doesn't
// depend on the threads; and a thread that waits for others takes nothing else up meanwhile.
#include "formats/base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

namespace lozenge {

namespace {

/// The error of the lowest number that threw. Numbers above it needn't be tried any more.
class FirstError {
 public:
  void run(std::size_t i, const std::function<void(std::size_t)>& work) {
    if (i > number_) return;
    try {
      work(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (i > number_) return;
      number_ = i;
      error_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<std::size_t> number_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr error_;
  std::mutex mutex_;
};

/// A thread that waits for this loop must not begin with something else: what it is in the middle of (a trial on a copy
/// of the map, say) may hold memory that belongs to the thread.
void run_on_all_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  FirstError error;
  tbb::this_task_arena::isolate(
      [&] { tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { error.run(i, work); }); });
  error.rethrow();
}

}  // namespace

void for_each_index(std::size_t count, bool threads, const std::function<void(std::size_t)>& work) {
  if (threads) {
    run_on_all_threads(count, work);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void for_each_index(std::size_t count, const Progress& progress, std::string_view what,
                    const std::function<void(std::size_t)>& work) {
  // Progress is told by the thread that asked for the work alone, whenever one of its own numbers is done.
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<std::size_t> done = 0;
  report(progress, what, 0);
  run_on_all_threads(count, [&](std::size_t i) {
    work(i);
    const std::size_t so_far = ++done;
    if (std::this_thread::get_id() == here) {
      report(progress, what, static_cast<double>(so_far) / static_cast<double>(count));
    }
  });
  report(progress, what, 1);
}

void for_each_part(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work, std::size_t part) {
  const std::size_t parts = (count + part - 1) / part;
  for_each_index(parts, parts > 1, [&](std::size_t i) { work(i * part, std::min(count, (i + 1) * part)); });
}

int most_threads() { return tbb::this_task_arena::max_concurrency(); }

int this_thread() { return std::max(tbb::this_task_arena::current_thread_index(), 0); }

void on_this_thread(const std::function<void()>& work) {
  tbb::task_arena one_thread(1);
  one_thread.execute(work);
}

}  // namespace lozenge
