// Progress as text: on a terminal one line that changes in place, in a log a plain line from time to time.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace lozenge {

class ProgressDisplay {
 public:
  /// \param clock  seconds, from any zero
  /// \param write  takes text as it is
  ProgressDisplay(bool terminal, std::string title, std::function<double()> clock,
                  std::function<void(std::string_view)> write);

  /// Shows what is done and how much of it, from 0 to 1, with the rate and the time that is left. Most calls show
  /// nothing: a terminal gets 10 updates a second, a log gets a line when something else begins (if the last line is a
  /// second old) and every 10 seconds.
  void update(std::string_view what, double done);

  /// Empties the line on a terminal, so that other text can follow.
  void clear();

 private:
  bool is_due(bool something_else, double now) const;
  std::string text(double done, double now) const;

  bool terminal_;
  std::string title_;
  std::function<double()> clock_;
  std::function<void(std::string_view)> write_;

  std::string what_;
  double begin_ = 0;       ///< when `what_` began
  double begin_done_ = 0;  ///< how much of it was done then
  double last_done_ = 0;
  double last_shown_ = -1e9;
  bool line_is_used_ = false;
};

/// "850 ms", "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace lozenge
