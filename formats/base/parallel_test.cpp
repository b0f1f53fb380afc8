#include "formats/base/parallel.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>

namespace lozenge {
namespace {

TEST(Parallel, VisitsEveryNumberOnce) {
  for (const std::size_t count : {0, 1, 7, 2048, 2049, 10000}) {
    std::vector<std::atomic<int>> visits(count), visits_of_parts(count), visits_told(count);
    for_each_index(count, true, [&](std::size_t i) { ++visits[i]; });
    for_each_index(count, {}, "", [&](std::size_t i) { ++visits_told[i]; });
    for_each_part(
        count,
        [&](std::size_t begin, std::size_t end) {
          EXPECT_LE(end - begin, 100U);
          for (std::size_t i = begin; i < end; ++i) ++visits_of_parts[i];
        },
        100);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(visits[i], 1);
      EXPECT_EQ(visits_told[i], 1);
      EXPECT_EQ(visits_of_parts[i], 1);
    }
  }
}

TEST(Parallel, TellsTheErrorOfTheLowestNumberOnAnyNumberOfThreads) {
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    for (int again = 0; again < 50; ++again) {
      try {
        for_each_index(1000, true, [&](std::size_t i) {
          if (i % 100 == 37) throw std::runtime_error(std::to_string(i));
        });
        ADD_FAILURE() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "37");
      }
    }
  }
}

TEST(Parallel, TellsItsProgressFromTheThreadThatAskedUpToTheEnd) {
  const std::thread::id here = std::this_thread::get_id();
  double last = -1;
  const Progress progress = [&](std::string_view what, double done) {
    EXPECT_EQ(std::this_thread::get_id(), here);
    EXPECT_EQ(what, "counting");
    EXPECT_GE(done, last);
    last = done;
  };
  for_each_index(5000, progress, "counting", [](std::size_t) {});
  EXPECT_EQ(last, 1);
}

TEST(Parallel, SortsAsOneThreadWouldOnAnyNumberOfThreads) {
  std::mt19937 random(1);
  for (const std::size_t count : {0, 1, 5000, 100001}) {
    std::vector<std::uint32_t> values(count);
    for (auto& value : values) value = random() % 50000;
    std::vector<std::uint32_t> expected = values;
    std::sort(expected.begin(), expected.end());
    for (const std::size_t threads : {1, 3}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      std::vector<std::uint32_t> sorted = values;
      sort_on_all_threads(sorted);
      EXPECT_EQ(sorted, expected);
    }
  }
}

}  // namespace
}  // namespace lozenge
