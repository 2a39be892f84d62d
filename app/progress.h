#pragma once
// How a headless render tells how far it is, on standard error.

#include <chrono>
#include <string>

#include "core/session/session.h"

namespace lightbench {

enum class ProgressMode { Bar, Plain, None };

/// `bar`, `plain` or `none`; empty means a bar on a terminal and plain lines elsewhere. Throws
/// Error{Usage}.
ProgressMode parse_progress(const std::string& text);

/// A bar is one line that is rewritten; plain lines come every few seconds.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(ProgressMode mode);
  /// Removes the bar.
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void update(const SessionStatus& status);
  /// Takes the bar away so that another line can be printed; the next update draws it again.
  void clear();

 private:
  ProgressMode mode_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace lightbench
