#include "pipeline/batch/batch_manifest.h"

#include <gtest/gtest.h>

#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

BatchRow row_with(const std::string& output, const std::string& status) {
  BatchRow row;
  row.asset = output + ".glb";
  row.output = output;
  row.status = status;
  row.message = "\"quoted\"\nand \xFF";
  row.triangles = {300, 20};
  row.deviation = 0.1;
  return row;
}

TEST(BatchManifest, TheLastRowOfAnOutputCounts) {
  const fixtures::TestFolder folder;
  append_row(folder / "m", row_with("a", "killed"));
  append_row(folder / "m", row_with("b", "failed"));
  append_row(folder / "m", row_with("a", "done"));
  const auto rows = read_manifest(folder / "m");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows.at("a").status, "done");
  EXPECT_EQ(rows.at("a").triangles, (std::vector<std::int64_t>{300, 20}));
  EXPECT_EQ(rows.at("a").deviation, 0.1);
  EXPECT_FALSE(rows.at("a").largest_deviation);
  EXPECT_EQ(rows.at("b").status, "failed");
  EXPECT_TRUE(read_manifest(folder / "none").empty());
}

TEST(BatchManifest, WhereverARowWasCutShortTheOthersStayWhatTheyAre) {
  const fixtures::TestFolder folder;
  const std::string line = row_text(row_with("b", "done")) + "\n";
  for (std::size_t size = 0; size <= line.size(); ++size) {
    fixtures::write_bytes(folder / "m", row_text(row_with("a", "done")) + "\n" + line.substr(0, size));
    append_row(folder / "m", row_with("c", "done"));
    const auto rows = read_manifest(folder / "m");
    EXPECT_TRUE(rows.contains("a") && rows.contains("c")) << size;
    EXPECT_EQ(rows.contains("b"), size + 1 >= line.size()) << size;
  }
}

}  // namespace
}  // namespace lozenge
