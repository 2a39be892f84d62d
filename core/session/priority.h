#pragma once
// How soon the system gives the calling thread its turn. Both are wishes: where the system does not
// know them, nothing changes.

namespace lightbench {

/// For threads that compute whatever is left to compute: others go first.
void lower_priority();

/// For threads that sleep until something happens and then do little: they interrupt a thread that
/// computes instead of waiting for the end of its slice (Linux 6.12 on; EEVDF, Stoica and
/// Abdel-Wahab 1995), without a greater share of the processor. Threads that they make do not
/// inherit it.
void react_promptly();

}  // namespace lightbench
