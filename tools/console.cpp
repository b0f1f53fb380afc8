#include "tools/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "formats/base/error.h"
#include "tools/interrupt.h"
#include "tools/progress_display.h"

namespace lozenge {
namespace {

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void write_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Console::Console(std::string command, bool json, bool quiet)
    : command_(std::move(command)), json_(json), quiet_(quiet) {
  if (!quiet_) display_ = std::make_unique<ProgressDisplay>(isatty(STDERR_FILENO) == 1, command_, now, write_to_stderr);
}

Console::~Console() = default;

void Console::print(const std::vector<std::string>& lines, const std::string& json) {
  if (display_) display_->clear();
  talk_.lines = lines;
  talk_.json = json;
  if (json_) {
    fmt::print("{}\n", json);
  } else {
    for (const std::string& line : lines) fmt::print("{}\n", line);
  }
}

void Console::say(const std::string& line) {
  if (!quiet_) complain(line);
}

void Console::note(const std::string& subject, const std::string& line) {
  talk_.notes.push_back(line);
  say(subject + ": " + line);
}

void Console::complain(const std::string& line) {
  if (display_) display_->clear();
  write_to_stderr(fmt::format("{}: {}\n", command_, line));
}

Progress Console::progress() {
  return [this](std::string_view what, double done) {
    throw_if_interrupted();
    if (display_) display_->update(what, done);
  };
}

void Console::finish() {
  if (display_) display_->clear();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw Error(ExitCode::kSystem, "standard output: can't be written; is the disk full?");
  }
}

}  // namespace lozenge
