#include "formats/base/scratch_folder.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "formats/base/atomic_file.h"
#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

/// Does `work` in a process of its own, which is killed when it has done it.
template <typename Work>
void be_killed_after(const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
}

std::size_t count_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(ScratchFolder, GoesWithAllThatIsInIt) {
  const fixtures::TestFolder folder;
  {
    const ScratchFolder scratch(folder.path(), ".made-");
    fs::create_directory(scratch.path() / "a");
    fixtures::write_bytes(scratch.path() / "a" / "b", "bytes");
    EXPECT_EQ(count_in(folder.path()), 1U);
  }
  EXPECT_EQ(count_in(folder.path()), 0U);
}

TEST(ScratchFolder, WhatAKilledProcessLeftIsRemovedByTheNext) {
  const fixtures::TestFolder folder;
  be_killed_after([&] {
    const auto* scratch = new ScratchFolder(folder.path(), ".made-");
    fixtures::write_bytes(scratch->path() / "half", "bytes");
  });
  EXPECT_EQ(count_in(folder.path()), 1U);
  const ScratchFolder next(folder.path(), ".made-");
  EXPECT_EQ(count_in(folder.path()), 1U) << "its own";
}

TEST(ScratchFolder, WhatOthersWorkInStays) {
  const fixtures::TestFolder folder;
  const ScratchFolder first(folder.path(), ".made-");
  const ScratchFolder second(folder.path(), ".made-");
  EXPECT_TRUE(fs::exists(first.path()));
  EXPECT_NE(first.path(), second.path());
  be_killed_after([&] { const ScratchFolder third(folder.path(), ".made-"); });
  EXPECT_TRUE(fs::exists(first.path()));
  EXPECT_TRUE(fs::exists(second.path()));
}

TEST(ScratchFolder, FoldersOfOtherNamesAndAnotherMachinesYoungOnesStay) {
  const fixtures::TestFolder folder;
  const fs::path others = folder / ".made-00000000-abcdef";
  fs::create_directory(folder / "made-by-hand");
  fs::create_directory(others);
  fixtures::write_bytes(others / ScratchFolder::kHeldName, "");
  const ScratchFolder scratch(folder.path(), ".made-");
  EXPECT_TRUE(fs::exists(folder / "made-by-hand"));
  EXPECT_TRUE(fs::exists(others));
}

TEST(ScratchFolder, ManyAtOnceInOnePlaceTakeNoneForAbandoned) {
  const fixtures::TestFolder folder;
  std::atomic<int> lost = 0;
  std::vector<std::thread> makers;
  // Locks belong to open files, so threads are to each other what processes are.
  for (int n = 0; n < 4; ++n) {
    makers.emplace_back([&] {
      for (int round = 0; round < 300; ++round) {
        const ScratchFolder scratch(folder.path(), ".made-");
        std::this_thread::yield();
        if (!fs::exists(scratch.path() / ScratchFolder::kHeldName)) ++lost;
      }
    });
  }
  for (std::thread& maker : makers) maker.join();
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(count_in(folder.path()), 0U);
}

TEST(ScratchFolder, AnotherMachinesFolderIsGivenUpAfterADay) {
  const fixtures::TestFolder folder;
  const fs::path others = folder / ".made-00000000-abcdef";
  fs::create_directory(others);
  fixtures::write_bytes(others / ScratchFolder::kHeldName, "");
  fs::last_write_time(others, fs::file_time_type::clock::now() - std::chrono::hours(25));
  const ScratchFolder scratch(folder.path(), ".made-");
  EXPECT_FALSE(fs::exists(others));
}

TEST(AbandonedFiles, OfAKilledProcessAreRemovedByTheNextFileInTheFolder) {
  const fixtures::TestFolder folder;
  fixtures::write_bytes(folder / ".hidden.tmp", "somebody else's");
  be_killed_after([&] { new AtomicFile(folder / "statue.exr"); });
  AtomicFile held(folder / "other.exr");
  EXPECT_EQ(count_in(folder.path()), 2U) << "what is held now, and what was never ours";
  AtomicFile second(folder / "statue.exr");
  EXPECT_TRUE(fs::exists(held.temporary_path()));
  EXPECT_TRUE(fs::exists(folder / ".hidden.tmp"));
}

}  // namespace
}  // namespace lozenge
