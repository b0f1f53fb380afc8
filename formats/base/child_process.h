// A program, run as a process of its own that ends when we end.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lozenge {

struct ChildOutcome {
  int code = 0;    ///< exit code; 128 + signal where a signal ended it
  int signal = 0;  ///< that ended it, or 0
  double seconds = 0;
  double peak_memory_mb = 0;  ///< resident, in 10^6 bytes
};

class ChildProcess {
 public:
  /// Starts the program; it reads nothing.
  /// \param words  the program's path first
  /// \param out, err  files that take its standard output and error
  /// \throws Error(kSystem) where no process can be started
  ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& out,
               const std::filesystem::path& err);
  /// Ends it: SIGTERM, and SIGKILL where that isn't heard for a while.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Whether it has ended, and how. Never waits. \pre not called again once it has
  std::optional<ChildOutcome> outcome();

  double seconds() const;
  /// Sends a signal to it and all that it has started.
  void send(int signal) const;

 private:
  std::chrono::steady_clock::time_point start_;
  pid_t process_ = 0;  ///< 0 once it was waited for
};

}  // namespace lozenge
