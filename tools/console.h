// How a command talks: results on stdout, everything else on stderr.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "formats/base/progress.h"

namespace lozenge {

class ProgressDisplay;

class Console {
 public:
  /// \param command  begins every line on stderr, as "lozenge build"
  Console(std::string command, bool json, bool quiet);
  ~Console();

  /// The result, for people as lines or for scripts as JSON, whichever was asked for.
  void print(const std::vector<std::string>& lines, const std::string& json);
  /// One line on stderr about the work; nothing with --quiet.
  void say(const std::string& line);
  /// The same about what was found in the input or made of it: it is true again where that is taken from a cache.
  /// \param subject  what it is about, as the user named it
  void note(const std::string& subject, const std::string& line);
  /// One line on stderr, even with --quiet.
  void complain(const std::string& line);

  /// To hand to a stage: shows how far it is, on a terminal as one line that changes, in a log as plain lines.
  /// Where the user stops the run, it throws Interrupted out of the stage.
  Progress progress();

  /// Clears what progress shows and hands all results over to the system.
  /// \throws Error(kSystem) where stdout can't take them (a full disk)
  void finish();

  /// What was said of the results so far.
  struct Talk {
    std::vector<std::string> notes;
    std::vector<std::string> lines;
    std::string json;
  };
  const Talk& talk() const { return talk_; }

 private:
  std::string command_;
  bool json_;
  bool quiet_;
  std::unique_ptr<ProgressDisplay> display_;
  Talk talk_;
};

}  // namespace lozenge
