#include "pipeline/cache/cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "formats/base/content_hash.h"
#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

namespace fs = std::filesystem;

class CacheTest : public testing::Test {
 protected:
  static std::string key(int number) { return content_hash(std::to_string(number)); }
  fs::path place(int number) const { return folder_ / "cache" / key(number).substr(0, 2) / (key(number) + ".entry"); }
  void store(int number, const std::string& bytes) const {
    fixtures::write_bytes(folder_ / "made", bytes);
    EXPECT_EQ(cache_.store(key(number), {{{"statue.glb", folder_ / "made"}}, {{"talk", "it is good"}}}), std::nullopt);
  }

  fixtures::TestFolder folder_;
  Cache cache_{folder_ / "cache"};
};

TEST_F(CacheTest, GivesBackWhatWasStored) {
  const std::string bytes("\0\r\n\xFF and more", 13);
  EXPECT_FALSE(cache_.find(key(1)));
  store(1, bytes);
  const auto entry = cache_.find(key(1));
  ASSERT_TRUE(entry);
  EXPECT_EQ(entry->names(), (std::vector<std::string>{"statue.glb", "talk"}));
  EXPECT_EQ(entry->text("talk"), "it is good");
  EXPECT_TRUE(entry->extract("statue.glb", folder_ / "out"));
  EXPECT_EQ(fixtures::bytes_of(folder_ / "out"), bytes);
  EXPECT_FALSE(entry->text("nothing of that name"));
  EXPECT_FALSE(cache_.find(key(2)));
}

TEST_F(CacheTest, TakesNoEntryForWhatItIsNotWhicheverByteWasDamaged) {
  store(1, "some bytes that matter");
  const std::string whole = fixtures::bytes_of(place(1));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    fixtures::write_bytes(place(1), damaged);
    const auto entry = cache_.find(key(1));
    const bool is_taken = entry && entry->text("talk") && entry->extract("statue.glb", folder_ / "out");
    EXPECT_FALSE(is_taken) << "byte " << at;
  }
}

TEST_F(CacheTest, TakesNoEntryThatIsCutShortOrContinued) {
  store(1, "some bytes that matter");
  const std::string whole = fixtures::bytes_of(place(1));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    fixtures::write_bytes(place(1), whole.substr(0, size));
    EXPECT_FALSE(cache_.find(key(1))) << size << " bytes";
    EXPECT_FALSE(fs::exists(place(1))) << "what is damaged is removed";
  }
  fixtures::write_bytes(place(1), whole + "x");
  EXPECT_FALSE(cache_.find(key(1)));
}

TEST_F(CacheTest, TakesNoEntryUnderTheNameOfAnother) {
  store(1, "one");
  store(2, "two");
  fs::rename(place(2), place(1));
  EXPECT_FALSE(cache_.find(key(1)));
}

TEST_F(CacheTest, AnOpenEntryOutlivesItsRemoval) {
  store(1, "bytes");
  const auto entry = cache_.find(key(1));
  EXPECT_EQ(cache_.prune(0).removed, 1);
  EXPECT_FALSE(cache_.find(key(1)));
  EXPECT_EQ(entry->text("statue.glb"), "bytes");
}

TEST_F(CacheTest, PruneRemovesWhatWasUsedLongestAgoUntilTheRestFits) {
  for (int k = 0; k < 4; ++k) store(k, std::string(10'000, 'x'));
  for (int k = 0; k < 4; ++k) {
    fs::last_write_time(place(k), fs::file_time_type::clock::now() - std::chrono::hours(10 - k));
  }
  ASSERT_TRUE(cache_.find(key(0))) << "used now";
  const Cache::Facts facts = cache_.prune(25'000);
  EXPECT_EQ(facts.removed, 2);
  EXPECT_EQ(facts.entries, 2);
  EXPECT_LE(facts.bytes, 25'000U);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(fs::exists(place(k)), k == 0 || k == 3) << k;
  EXPECT_EQ(cache_.prune(0).entries, 0);
}

TEST_F(CacheTest, SaysWhyItCannotStoreAndLeavesNothing) {
  fixtures::write_bytes(folder_ / "made", "bytes");
  const Cache no_folder(folder_ / "made");
  EXPECT_TRUE(no_folder.store(key(1), {{{"statue.glb", folder_ / "made"}}, {}}));
  EXPECT_TRUE(cache_.store(key(1), {{{"statue.glb", folder_ / "missing"}}, {}}));
  EXPECT_EQ(cache_.facts().entries, 0);
  EXPECT_TRUE(fs::is_empty(place(1).parent_path()));
}

}  // namespace
}  // namespace lozenge
