#include "tools/memory_limit.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

namespace lozenge {
namespace {

constexpr std::size_t kGigabyte = 1'000'000'000;

/// Takes memory that no compiler can see is of no use.
void take_a_gigabyte() { std::vector<char>(kGigabyte).at(kGigabyte / 2) += 1; }

/// Whether the limit has an effect here: memory of sanitizers is not limited.
bool has_effect() {
  const std::string before = memory_limit_in_words();
  limit_memory(1'000'000'000'000);
  return memory_limit_in_words() != before || before != "all there is";
}

TEST(MemoryLimitDeathTest, MakesTooLargeAllocationsFailWhichCanBeCaught) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // libraries that are linked have started threads
  if (!has_effect()) GTEST_SKIP() << "under a sanitizer, memory isn't limited";
  EXPECT_EXIT(
      {
        limit_memory(500'000'000);
        try {
          take_a_gigabyte();
        } catch (const std::bad_alloc&) {
          std::_Exit(memory_limit_in_words() == "500 MB" ? 7 : 8);
        }
        std::_Exit(9);
      },
      ::testing::ExitedWithCode(7), "");
}

TEST(MemoryLimitDeathTest, EndsTheProcessWithItsExitCodeWhereNobodyCatches) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // libraries that are linked have started threads
  if (!has_effect()) GTEST_SKIP() << "under a sanitizer, memory isn't limited";
  EXPECT_EXIT(
      {
        limit_memory(500'000'000);
        std::thread(take_a_gigabyte).join();
      },
      ::testing::ExitedWithCode(5), "lozenge: out of memory");
}

TEST(MemoryLimitDeathTest, CanBeLifted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // libraries that are linked have started threads
  if (!has_effect()) GTEST_SKIP() << "under a sanitizer, memory isn't limited";
  EXPECT_EXIT(
      {
        limit_memory(500'000'000);
        lift_memory_limit();
        take_a_gigabyte();
        std::_Exit(7);
      },
      ::testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace lozenge
