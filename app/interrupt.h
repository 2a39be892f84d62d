#pragma once
// Ctrl-C and SIGTERM as a request to stop, so that a render can save what it has.

namespace lightbench {

/// From now on the first SIGINT or SIGTERM is only remembered; a second ends the process at once.
void catch_interrupts();

/// 0, or the signal that arrived. The exit code of a stopped run is 128 + signal.
int interrupt_signal();

}  // namespace lightbench
