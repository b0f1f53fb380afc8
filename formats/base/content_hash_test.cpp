#include "formats/base/content_hash.h"

#include <gtest/gtest.h>

#include "formats/base/error.h"
#include "formats/base/file_fixtures.h"

namespace lozenge {
namespace {

TEST(ContentHasher, GivesTheHashesThatOthersGive) {
  // As Python's hashlib.blake2b(…, digest_size=32) has them: no block, part of one, one exactly, a byte more, many.
  const std::pair<std::string, std::string> hashes[] = {
      {"", "0e5751c026e543b2e8ab2eb06099daa1d1e5df47778f7787faab45cdf12fe3a8"},
      {"abc", "bddd813c634239723171ef3fee98579b94964e3bb1cb3e427262c8c068d52319"},
      {std::string(128, 'a'), "ae2aa48507885c4c950fb809b2076f959cde9f8ea6da260d9a3587df33dac450"},
      {std::string(129, 'a'), "2f64744a6de0d2c0b56e64cf6e29a5aaa255010d415d51c75ccc82f73dccd865"}};
  for (const auto& [bytes, hash] : hashes) EXPECT_EQ(content_hash(bytes), hash) << bytes.size();
  std::string many;
  for (int k = 0; k < 1000; ++k) many += "lozenge";
  EXPECT_EQ(content_hash(many), "accd5d142c1efeb8404c1fbe037e8c3c9c53d38d1b65f101329752cad8047872");
}

TEST(ContentHasher, DoesNotDependOnHowBytesAreCutIntoPieces) {
  std::string bytes;
  for (int k = 0; k < 700; ++k) bytes += static_cast<char>(k * k);
  for (const std::size_t piece : {1U, 7U, 127U, 128U, 129U, 300U}) {
    ContentHasher hasher;
    for (std::size_t at = 0; at < bytes.size(); at += piece) hasher.add(std::string_view(bytes).substr(at, piece));
    EXPECT_EQ(hasher.finish(), content_hash(bytes)) << piece;
  }
}

TEST(ContentHasher, FieldsDoNotRunIntoEachOther) {
  EXPECT_NE(ContentHasher().add_field("ab").add_field("c").finish(),
            ContentHasher().add_field("a").add_field("bc").finish());
  EXPECT_NE(ContentHasher().add_field("a").finish(), ContentHasher().add_field("a").add_field("").finish());
}

TEST(ContentHasher, AFileHasTheHashOfItsBytes) {
  const fixtures::TestFolder folder;
  const std::string bytes(1'000'000, 'x');
  fixtures::write_bytes(folder / "x", bytes);
  EXPECT_EQ(content_hash_of_file(folder / "x"), content_hash(bytes));
  EXPECT_THROW(content_hash_of_file(folder / "none"), Error);
}

}  // namespace
}  // namespace lozenge
