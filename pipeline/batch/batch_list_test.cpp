#include "pipeline/batch/batch_list.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

/// [asset] its output
std::map<std::string, std::string> outputs_of(const std::vector<BatchItem>& items) {
  std::map<std::string, std::string> outputs;
  for (const BatchItem& item : items) outputs[item.asset] = item.output;
  return outputs;
}

void write(const fs::path& file) {
  fs::create_directories(file.parent_path());
  fixtures::write_bytes(file, "x");
}

TEST(BatchList, AFolderGivesAllThatIsCalledAnAssetAndOutputsLieAsTheyDo) {
  const fixtures::TestFolder folder;
  for (const char* name :
       {"a.glb", "rocks/b.PLY", "rocks/b.txt", ".hidden.glb", ".git/c.glb", "out/d.glb", "same.obj", "same.stl"}) {
    write(folder / name);
  }
  const auto outputs = outputs_of(items_in_folder(folder.path(), folder / "out"));
  EXPECT_EQ(outputs,
            (std::map<std::string, std::string>{
                {"a.glb", "a"}, {"rocks/b.PLY", "rocks/b"}, {"same.obj", "same.obj"}, {"same.stl", "same.stl"}}));
  EXPECT_THROW(items_in_folder(folder / "none", folder / "out"), Error);
}

TEST(BatchList, AListIsReadBackAsItWasWritten) {
  const fixtures::TestFolder folder;
  for (const char* name : {"a/x.glb", "b/x.glb", "b/y.glb"}) write(folder / name);
  fixtures::write_bytes(folder / "list", (folder / "a/x.glb").string() + "\r\n# no asset\n\n" +
                                             (folder / "b/x.glb").string() + "\n" + (folder / "b/y.glb").string() +
                                             "\tnamed/y\n");
  const std::vector<BatchItem> items = items_in_list(folder / "list");
  std::set<std::string> outputs;
  for (const BatchItem& item : items) outputs.insert(item.output);
  EXPECT_EQ(outputs, (std::set<std::string>{"a/x", "b/x", "named/y"}));
  fixtures::write_bytes(folder / "again", list_text(items));
  std::set<std::string> again;
  for (const BatchItem& item : items_in_list(folder / "again")) again.insert(item.output);
  EXPECT_EQ(again, outputs);
}

TEST(BatchList, RefusesOutputsThatWouldLeaveTheFolderOrBeOne) {
  const fixtures::TestFolder folder;
  for (const char* line : {"a.glb\t../a", "a.glb\t/a", "a.glb\ta/", "a.glb\tsame\nb.glb\tsame", "", "# nothing"}) {
    fixtures::write_bytes(folder / "list", line);
    EXPECT_THROW(items_in_list(folder / "list"), Error) << line;
  }
}

TEST(BatchList, ShardsHaveEachItemOnceAndNoneMuchMoreWorkThanAnother) {
  std::mt19937 random(1);
  for (const std::size_t shards : {1U, 2U, 7U, 100U}) {
    std::vector<BatchItem> items;
    double most = 0;
    double all = 0;
    for (int k = 0; k < 60; ++k) {
      items.push_back({"", std::to_string(k), std::to_string(k), random() % 10'000'000});
      most = std::max(most, work_of(items.back()));
      all += work_of(items.back());
    }
    const auto made = in_shards(items, shards);
    EXPECT_EQ(made.size(), std::min<std::size_t>(shards, items.size()));
    std::set<std::string> seen;
    for (const auto& shard : made) {
      double work = 0;
      for (const BatchItem& item : shard) {
        work += work_of(item);
        EXPECT_TRUE(seen.insert(item.asset).second);
      }
      // Graham: no shard is filled further once it has the mean.
      EXPECT_LE(work, all / static_cast<double>(made.size()) + most);
    }
    EXPECT_EQ(seen.size(), items.size());
  }
}

}  // namespace
}  // namespace lozenge
