#include "tools/interrupt.h"

#include <signal.h>

#include <initializer_list>

namespace lozenge {
namespace {

volatile sig_atomic_t signal_that_came = 0;

void remember(int signal) { signal_that_came = signal; }

}  // namespace

void watch_for_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

void throw_if_interrupted() {
  if (signal_that_came != 0) throw Interrupted(signal_that_came);
}

}  // namespace lozenge
