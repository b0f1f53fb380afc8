#include "tools/manual.h"

#include <gtest/gtest.h>

namespace lozenge {
namespace {

struct Arguments {
  std::string input;
  std::string output;
  int bits = 8;
  std::string note;
};

void declare(Options& options, Arguments& arguments) {
  options.input("input", arguments.input, "What to read");
  options.output(arguments.output, "Where to");
  options.one_of("--bits N", arguments.bits, {8, 16}, "Bits of each").shows_default();
  options.text("--note TEXT", arguments.note, ".hidden and C:\\path");
}

ExitCode run(const Arguments&, Console&) { return ExitCode::kDone; }

Command example() {
  return make_command<Arguments>({"press", "Make it flat", kStageGroup, "  flat\n    lozenge press a.glb -o b.glb"},
                                 declare, run);
}

const ProgramHelp kProgram{"lozenge", "About it.", "Examples\n  one\n\nExit codes\n  0 done", "lozenge 1.2.3"};

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST(Manual, TellsOfEachOptionItsNamesValueDefaultAndText) {
  const std::string page = manual_of_command(kProgram, example());
  EXPECT_TRUE(has(page, "lozenge\\-press \\- Make it flat"));
  EXPECT_TRUE(has(page, "\\fBlozenge press\\fR \\fIinput\\fR \\fB\\-o\\fR \\fIPATH\\fR [\\fIoptions\\fR]"));
  EXPECT_TRUE(has(page, "\\fB\\-\\-bits\\fR \\fIN\\fR = 8\nBits of each\n"));
  EXPECT_TRUE(has(page, "\\fB\\-h\\fR, \\fB\\-\\-help\\fR\n"));
}

TEST(Manual, ShowsSignsOfRoffAsTheyAre) {
  EXPECT_TRUE(has(manual_of_command(kProgram, example()), "\n\\&.hidden and C:\\epath\n"));
}

TEST(Manual, ListsCommandsByGroupAndHasTheSectionsOfTheHelp) {
  const std::string page = manual_of_program(kProgram, {example()});
  EXPECT_TRUE(has(page, ".SS The same, one stage at a time\n.TP\n\\fBlozenge\\-press\\fR(1)\nMake it flat\n"));
  EXPECT_TRUE(has(page, ".SH EXAMPLES\n.nf\n  one\n.fi\n.SH EXIT CODES\n.nf\n  0 done\n.fi\n"));
}

TEST(BashCompletion, OffersWhatAnOptionTakes) {
  const std::string script = bash_completion(kProgram, {example()});
  EXPECT_TRUE(has(script, "-W '--help --version press'"));
  EXPECT_TRUE(has(script, "--bits) _lozenge_offer -W '8 16' ;;"));
  EXPECT_TRUE(has(script, "-o|--output) _lozenge_offer -f ;;"));
  EXPECT_TRUE(has(script, "--note) _lozenge_offer ;;"));
}

}  // namespace
}  // namespace lozenge
