#include "pipeline/quality/stage_clock.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstring>
#include <fstream>

namespace lozenge {
namespace {

/// Straight from the kernel and back to it, so that no allocator keeps the pages.
void touch_200_megabytes() {
  constexpr std::size_t kSize = 200'000'000;
  void* block = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(block, MAP_FAILED);
  std::memset(block, 1, kSize);
  munmap(block, kSize);
}

TEST(StageClock, StagesFollowEachOtherInTheOrderInWhichTheyRan) {
  StageClock clock;
  for (const char* name : {"import", "sample", "bake"}) clock.begin(name);
  clock.end();
  ASSERT_EQ(clock.stages().size(), 3u);
  EXPECT_EQ(clock.stages()[0].name, "import");
  EXPECT_EQ(clock.stages()[1].name, "sample");
  EXPECT_EQ(clock.stages()[2].name, "bake");
}

TEST(StageClock, StagesTakeNoLongerThanTheWhole) {
  StageClock clock;
  double sum = 0;
  for (const char* name : {"a", "b"}) {
    clock.begin(name);
    sum += clock.end().seconds;
  }
  EXPECT_GE(sum, 0);
  EXPECT_LE(sum, clock.seconds());
}

TEST(StageClock, TheMemoryThatAStageTouchesIsInItsPeak) {
  StageClock clock;
  clock.begin("small");
  const double before = clock.end().peak_memory_mb;
  clock.begin("large");
  touch_200_megabytes();
  const double large = clock.end().peak_memory_mb;
  EXPECT_GT(before, 0);
  EXPECT_GT(large, before + 150);  // the block, less what the stage before may have touched and given back
  EXPECT_GE(clock.peak_memory_mb(), large);
}

TEST(StageClock, APeakIsForgottenWhereTheSystemCanDoThat) {
  if (!(std::ofstream("/proc/self/clear_refs") << "5").flush())
    GTEST_SKIP() << "the kernel can't forget a peak of memory";
  StageClock clock;
  clock.begin("large");
  touch_200_megabytes();
  const double large = clock.end().peak_memory_mb;
  clock.begin("small");
  EXPECT_LT(clock.end().peak_memory_mb, large - 150);
}

}  // namespace
}  // namespace lozenge
