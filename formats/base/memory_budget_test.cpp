#include "formats/base/memory_budget.h"

#include <gtest/gtest.h>

#include "formats/base/error.h"

namespace lozenge {
namespace {

TEST(MemoryBudget, AddsUpAndStopsAtTheFirstThatIsTooMuch) {
  MemoryBudget budget(1'000);
  budget.take(600, "a");
  budget.take(400, "b");
  EXPECT_EQ(budget.taken(), 1'000U);
  EXPECT_THROW(budget.take(1, "c"), Error);
}

TEST(MemoryBudget, SaysWhatWasAskedForTheLimitAndWhatToDo) {
  try {
    require_memory(12'300'000'000, 8'000'000'000, "statue.glb: importing it");
    FAIL() << "was allowed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kLimit);
    const std::string message = error.what();
    for (const char* text : {"statue.glb: importing it", "12.3 GB", "8.0 GB", "--max-memory"}) {
      EXPECT_NE(message.find(text), std::string::npos) << message;
    }
  }
}

TEST(MemoryBudget, WithoutALimitAllIsAllowedAndNoSumOverflows) {
  MemoryBudget budget;
  for (int i = 0; i < 3; ++i) budget.take(UINT64_MAX / 2, "much");
  EXPECT_EQ(budget.taken(), UINT64_MAX);
  MemoryBudget limited(5);
  EXPECT_THROW(limited.take(UINT64_MAX, "all"), Error);
  EXPECT_THROW(limited.take(UINT64_MAX, "all again"), Error);
}

}  // namespace
}  // namespace lozenge
