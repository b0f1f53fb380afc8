#include "formats/base/atomic_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  std::ptrdiff_t file_count() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  fixtures::TestFolder folder_;
};

TEST_F(AtomicFileTest, AppearsUnderItsNameOnlyWhenCommitted) {
  AtomicFile file(folder_ / "map.exr");
  EXPECT_EQ(file.temporary_path().parent_path(), folder_.path());
  EXPECT_EQ(file.temporary_path().extension(), ".exr");
  std::ofstream(file.temporary_path()) << "whole";
  EXPECT_FALSE(fs::exists(folder_ / "map.exr"));
  file.commit();
  EXPECT_EQ(fixtures::bytes_of(folder_ / "map.exr"), "whole");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, LeavesTheOlderFileAndNothingElseWithoutACommit) {
  write_file_whole(folder_ / "a.json", "old");
  {
    const AtomicFile file(folder_ / "a.json");
    std::ofstream(file.temporary_path()) << "half of the ne";
  }
  EXPECT_EQ(fixtures::bytes_of(folder_ / "a.json"), "old");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, ReplacesAnOlderFileByBytesOfAnyKind) {
  const std::string bytes("\0\n\r\n\xFF", 5);
  write_file_whole(folder_ / "a.bin", "something longer than that");
  write_file_whole(folder_ / "a.bin", bytes);
  EXPECT_EQ(fixtures::bytes_of(folder_ / "a.bin"), bytes);
}

TEST_F(AtomicFileTest, SeveralOfTheSameTargetDoNotMeet) {
  AtomicFile first(folder_ / "a.bin");
  AtomicFile second(folder_ / "a.bin");
  EXPECT_NE(first.temporary_path(), second.temporary_path());
  std::ofstream(first.temporary_path()) << "first";
  std::ofstream(second.temporary_path()) << "second";
  first.commit();
  second.commit();
  EXPECT_EQ(fixtures::bytes_of(folder_ / "a.bin"), "second");
  EXPECT_EQ(file_count(), 1);
}

TEST_F(AtomicFileTest, NamesTheFolderThatCannotBeWritten) {
  write_file_whole(folder_ / "file", "");
  for (const fs::path& target :
       {folder_ / "missing" / "a.glb", folder_ / "file" / "a.glb", folder_.path(), fs::path("/proc/a.glb")}) {
    try {
      write_file_whole(target, "bytes");
      ADD_FAILURE() << target << " was written";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      EXPECT_EQ(std::string(error.what()).find(target.string() + ": can't be written: "), 0U) << error.what();
    }
  }
  EXPECT_EQ(file_count(), 1);
}

}  // namespace
}  // namespace lozenge
