#include "tools/progress_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lozenge {
namespace {

constexpr double kTerminalInterval = 0.1;  // seconds; faster than one can read
constexpr double kLogInterval = 10;        // a log is read afterwards
constexpr double kLogChange = 1;           // so that a hundred short steps don't make a hundred lines
constexpr double kRateTime = 0.5;          // below this a rate is noise

constexpr std::string_view kEraseLine = "\r\033[K";

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 1) return fmt::format("{:.0f} ms", seconds * 1000);
  const auto s = static_cast<long long>(std::llround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

ProgressDisplay::ProgressDisplay(bool terminal, std::string title, std::function<double()> clock,
                                 std::function<void(std::string_view)> write)
    : terminal_(terminal), title_(std::move(title)), clock_(std::move(clock)), write_(std::move(write)) {}

void ProgressDisplay::update(std::string_view what, double done) {
  const double now = clock_();
  done = std::clamp(done, 0.0, 1.0);
  const bool something_else = what != what_ || done < last_done_;
  if (something_else) {
    what_ = what;
    begin_ = now;
    begin_done_ = done;
  }
  last_done_ = done;
  if (!is_due(something_else, now)) return;
  last_shown_ = now;
  if (terminal_) {
    write_(fmt::format("{}{}", kEraseLine, text(done, now)));
    line_is_used_ = true;
  } else {
    write_(text(done, now) + "\n");
  }
}

void ProgressDisplay::clear() {
  if (line_is_used_) write_(kEraseLine);
  line_is_used_ = false;
}

bool ProgressDisplay::is_due(bool something_else, double now) const {
  const double since = now - last_shown_;
  if (terminal_) return since >= kTerminalInterval;
  return since >= (something_else ? kLogChange : kLogInterval);
}

std::string ProgressDisplay::text(double done, double now) const {
  std::string line = fmt::format("{}: {} {:.0f} %", title_, what_, 100 * done);
  const double time = now - begin_;
  const double gained = done - begin_done_;
  if (time >= kRateTime && gained > 0 && done < 1) {
    const double rate = gained / time;
    line += fmt::format(", {:.2g} %/s, {} left", 100 * rate, duration_text((1 - done) / rate));
  }
  return line;
}

}  // namespace lozenge
