#include "tools/make_rule.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

TEST(MakeRule, NamesTheTargetAndEachFileOnceMoreAsATargetOfItsOwn) {
  EXPECT_EQ(make_rule("out/a.glb", {"a.gltf", "a.bin"}), "out/a.glb: \\\n  a.gltf \\\n  a.bin\n\na.gltf:\n\na.bin:\n");
  EXPECT_EQ(make_rule("out/a.glb", {}), "out/a.glb:\n");
}

TEST(MakeRule, EscapesWhatMakeTakesForItsOwn) {
  EXPECT_EQ(make_rule("a b", {"50$ #1.png"}), "a\\ b: \\\n  50$$\\ \\#1.png\n\n50$$\\ \\#1.png:\n");
  EXPECT_EQ(make_rule("a", {"back\\ b"}), "a: \\\n  back\\\\\\ b\n\nback\\\\\\ b:\n");
  EXPECT_EQ(make_rule("a", {"two\nlines"}), "a:\n");
}

}  // namespace
}  // namespace lozenge
