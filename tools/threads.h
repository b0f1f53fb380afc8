// How many threads the program uses.
#pragma once

#include <memory>

namespace lozenge {

/// While it lives, no library under us uses more than this many threads.
class ThreadLimit {
 public:
  /// \param threads  0: one for each core that the process may use
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace lozenge
