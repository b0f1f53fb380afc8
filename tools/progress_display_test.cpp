#include "tools/progress_display.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lozenge {
namespace {

struct Screen {
  double time = 0;
  std::string text;

  ProgressDisplay display(bool terminal) {
    return {terminal, "lozenge build", [this] { return time; }, [this](std::string_view t) { text += t; }};
  }
  long lines() const { return std::count(text.begin(), text.end(), '\n'); }
};

TEST(ProgressDisplay, TellsTheRateAndTheTimeThatIsLeft) {
  Screen screen;
  ProgressDisplay display = screen.display(true);
  display.update("bake", 0);
  screen.time = 30;
  display.update("bake", 0.25);
  EXPECT_NE(screen.text.find("lozenge build: bake 25 %, 0.83 %/s, 1 min 30 s left"), std::string::npos) << screen.text;
}

TEST(ProgressDisplay, CountsTheTimeOfEachThingFromItsOwnBeginning) {
  Screen screen;
  ProgressDisplay display = screen.display(true);
  display.update("import", 0);
  screen.time = 1000;
  display.update("bake", 0.5);
  screen.time = 1010;
  display.update("bake", 0.75);
  EXPECT_NE(screen.text.find("bake 75 %, 2.5 %/s, 10 s left"), std::string::npos) << screen.text;
}

TEST(ProgressDisplay, NeverBreaksTheLineOnATerminalAndLeavesItEmpty) {
  Screen screen;
  ProgressDisplay display = screen.display(true);
  for (int k = 0; k <= 100; ++k, screen.time += 0.3) display.update("sample", k / 100.0);
  display.clear();
  EXPECT_EQ(screen.lines(), 0);
  EXPECT_TRUE(screen.text.ends_with("\r\033[K"));
}

TEST(ProgressDisplay, ALogGetsWholeLinesWithoutControlCharacters) {
  Screen screen;
  ProgressDisplay display = screen.display(false);
  for (int k = 0; k <= 100; ++k, screen.time += 1) display.update("sample", k / 100.0);
  display.clear();
  EXPECT_EQ(screen.lines(), 11);  // at 0, 10, ... 100 seconds
  EXPECT_EQ(screen.text.find_first_of("\r\033"), std::string::npos);
}

TEST(ProgressDisplay, ShowsNoMoreThanAnybodyReadsHoweverOftenItIsCalled) {
  for (const bool terminal : {true, false}) {
    Screen screen;
    ProgressDisplay display = screen.display(terminal);
    for (int k = 0; k < 100'000; ++k, screen.time += 1e-5) display.update(k % 2 == 0 ? "collapse" : "flip", 0.5);
    EXPECT_LT(screen.text.size(), 12u * 80) << "one second of work";
  }
}

TEST(ProgressDisplay, ValuesOutOfRangeDoNoHarm) {
  Screen screen;
  ProgressDisplay display = screen.display(true);
  for (const double done : {-1.0, 0.0, 2.0, 1.0, 0.5}) {
    screen.time += 1;
    display.update("bake", done);
  }
  EXPECT_EQ(screen.text.find('-'), std::string::npos) << screen.text;
  EXPECT_EQ(screen.text.find("200"), std::string::npos) << screen.text;
}

TEST(DurationText, UsesTheUnitsThatOneWouldSay) {
  EXPECT_EQ(duration_text(0.85), "850 ms");
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
}

}  // namespace
}  // namespace lozenge
