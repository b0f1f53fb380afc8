// Ctrl-C and SIGTERM as an exception, so that a run that is stopped cleans up like one that fails.
#pragma once

#include <exception>

namespace lozenge {

/// Thrown by `throw_if_interrupted`.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(int signal) : signal_(signal) {}
  int signal() const { return signal_; }
  const char* what() const noexcept override { return "interrupted"; }

 private:
  int signal_;
};

/// Remembers the first SIGINT or SIGTERM from now on. A second one ends the process at once.
void watch_for_interrupts();

/// \throws Interrupted where a signal has come
void throw_if_interrupted();

}  // namespace lozenge
