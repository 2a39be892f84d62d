#include "app/interrupt.h"

#include <csignal>

namespace lightbench {
namespace {

// A signal handler can reach nothing but a global.
volatile std::sig_atomic_t received_signal = 0;

void remember(int signal) { received_signal = signal; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags =
      static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second one meets the default: to die
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interrupt_signal() { return received_signal; }

}  // namespace lightbench
