#include "formats/base/utf8.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

namespace lozenge {
namespace {

TEST(ValidUtf8, LeavesWellFormedTextAlone) {
  for (const char* text : {"", "statue", "\xC3\xA4\xE2\x82\xAC\xF0\x9F\x97\xBF", "quotes \" and \\ and \n"}) {
    EXPECT_EQ(valid_utf8(text), text);
  }
  EXPECT_EQ(valid_utf8(std::string_view("a\0b", 3)), std::string("a\0b", 3));
}

TEST(ValidUtf8, ReplacesBytesThatAreNoText) {
  EXPECT_EQ(valid_utf8("caf\xE9"), "caf\xEF\xBF\xBD");
  EXPECT_EQ(valid_utf8("\xFFx"), "\xEF\xBF\xBDx");
}

TEST(ValidUtf8, GivesTextThatJsonTakesForAnyBytes) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    std::string bytes(random() % 12, ' ');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string text = valid_utf8(bytes);
    EXPECT_NO_THROW(nlohmann::json(text).dump());
    EXPECT_EQ(valid_utf8(text), text);
  }
}

}  // namespace
}  // namespace lozenge
