#include "pipeline/output_set.h"

#include <gtest/gtest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "formats/base/error.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

class OutputSetTest : public ::testing::Test {
 protected:
  OutputSetTest() : root_(fs::path(::testing::TempDir()) / ("output_set_" + std::to_string(::getpid()))) {
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  ~OutputSetTest() override { fs::remove_all(root_); }

  static void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  static std::string read(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
  }

  fs::path root_;
};

TEST_F(OutputSetTest, FilesAppearOnlyOnCommitAndNothingElseDoes) {
  OutputSet set(root_ / "a" / "b");
  write(set.staged("one"), "1");
  write(set.staged("two"), "2");
  EXPECT_FALSE(fs::exists(root_ / "a" / "b" / "one"));
  const std::vector<fs::path> files = set.commit();
  EXPECT_EQ(files, (std::vector<fs::path>{root_ / "a" / "b" / "one", root_ / "a" / "b" / "two"}));
  EXPECT_EQ(read(files[0]), "1");
  EXPECT_EQ(read(files[1]), "2");
}

TEST_F(OutputSetTest, LeavesNoHiddenFolderBehind) {
  {
    OutputSet set(root_ / "out");
    write(set.staged("one"), "1");
    set.commit();
  }
  EXPECT_EQ(entries(root_ / "out"), 1u);
}

TEST_F(OutputSetTest, WithoutCommitEveryFolderThatWasMadeDisappears) {
  {
    OutputSet set(root_ / "a" / "b" / "c/");
    write(set.staged("one"), "1");
    EXPECT_TRUE(fs::exists(root_ / "a" / "b" / "c"));
  }
  EXPECT_EQ(entries(root_), 0u);
}

TEST_F(OutputSetTest, WithoutCommitAFolderThatWasThereStaysAsItWas) {
  fs::create_directory(root_ / "out");
  write(root_ / "out" / "one", "old");
  {
    OutputSet set(root_ / "out");
    write(set.staged("one"), "new");
  }
  EXPECT_EQ(entries(root_ / "out"), 1u);
  EXPECT_EQ(read(root_ / "out" / "one"), "old");
}

TEST_F(OutputSetTest, ReplacesFilesOfAnEarlierRun) {
  for (const char* text : {"first", "second"}) {
    OutputSet set(root_);
    write(set.staged("one"), text);
    set.commit();
    EXPECT_EQ(read(root_ / "one"), text);
  }
}

TEST_F(OutputSetTest, AFailureInTheMiddleOfACommitIsUndone) {
  write(root_ / "a", "old");
  fs::create_directory(root_ / "c");  // a file can't replace it
  {
    OutputSet set(root_);
    for (const char* name : {"a", "b", "c", "d"}) write(set.staged(name), "new");
    try {
      set.commit();
      FAIL() << "a folder was replaced by a file";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      EXPECT_NE(std::string(error.what()).find((root_ / "c").string()), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(read(root_ / "a"), "old");
  EXPECT_FALSE(fs::exists(root_ / "b"));
  EXPECT_FALSE(fs::exists(root_ / "d"));
  EXPECT_EQ(entries(root_), 2u);
}

TEST_F(OutputSetTest, AFolderBelowAFileIsRefusedAndNamed) {
  write(root_ / "file", "");
  try {
    OutputSet set(root_ / "file" / "out");
    FAIL() << "made a folder below a file";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(error.what()).find((root_ / "file").string()), std::string::npos) << error.what();
  }
}

TEST_F(OutputSetTest, AFileInPlaceOfTheFolderIsRefused) {
  write(root_ / "file", "");
  EXPECT_THROW(OutputSet set(root_ / "file"), Error);
  EXPECT_EQ(read(root_ / "file"), "");
}

TEST_F(OutputSetTest, TheFileThatOthersLookAtIsMovedLast) {
  // A folder has the name of the last one, so that moving it fails: all others had been moved by then.
  fs::create_directories(root_ / "out" / "b");
  OutputSet set(root_ / "out");
  for (const char* name : {"a", "b", "c"}) write(set.staged(name), "new");
  try {
    set.commit("b");
    ADD_FAILURE() << "a folder was replaced";
  } catch (const Error&) {
  }
  EXPECT_FALSE(fs::exists(set.staged("c"))) << "it came before b";
}

TEST_F(OutputSetTest, WhatAKilledProcessLeftIsRemovedByTheNext) {
  const pid_t child = fork();
  if (child == 0) {
    const auto* set = new OutputSet(root_ / "out");
    write(set->staged("half"), "of it");
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  EXPECT_EQ(entries(root_ / "out"), 1u);
  {
    OutputSet set(root_ / "out");
    write(set.staged("one"), "1");
    set.commit();
  }
  EXPECT_EQ(entries(root_ / "out"), 1u);
  EXPECT_TRUE(fs::exists(root_ / "out" / "one"));
}

}  // namespace
}  // namespace lozenge
