// How many threads the program uses.
#pragma once

#include <memory>

namespace lozenge {

/// While it lives, no more than this many threads are used by us, oneTBB and OpenEXR.
class ThreadLimit {
 public:
  /// \param threads  0: one for each core that the process may use
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  int threads() const { return threads_; }

  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  int threads_;
  std::unique_ptr<Control> control_;
};

}  // namespace lozenge
