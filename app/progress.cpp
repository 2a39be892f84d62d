#include "app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/format.h"

namespace lightbench {
namespace {

constexpr auto kBarInterval = std::chrono::milliseconds(100);
constexpr auto kPlainInterval = std::chrono::seconds(5);

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string progress_text(const SessionStatus& status) {
  std::string text = status.target_spp > 0 ? fmt::format("{}/{} spp", status.spp, status.target_spp)
                                           : fmt::format("{} spp", status.spp);
  text += fmt::format("  {}", format_duration(status.seconds));
  if (status.samples_per_second > 0) {
    text += "  " + format_count(status.samples_per_second, "samples/s");
  }
  if (status.remaining >= 0) text += fmt::format("  eta {}", format_duration(status.remaining));
  return text;
}

/// Share of the work done; by time where only time ends the render.
double share_done(const SessionStatus& status) {
  if (status.remaining < 0) return 0;
  const double total = status.seconds + status.remaining;
  return total > 0 ? std::clamp(status.seconds / total, 0.0, 1.0) : 1;
}

}  // namespace

ProgressMode parse_progress(const std::string& text) {
  if (text.empty()) return isatty(STDERR_FILENO) != 0 ? ProgressMode::Bar : ProgressMode::Plain;
  if (text == "bar") return ProgressMode::Bar;
  if (text == "plain") return ProgressMode::Plain;
  if (text == "none") return ProgressMode::None;
  throw Error(ErrorKind::Usage, fmt::format("--progress '{}': expected bar, plain or none", text));
}

ProgressDisplay::ProgressDisplay(ProgressMode mode) : mode_(mode) {
  if (mode == ProgressMode::Plain) next_ = std::chrono::steady_clock::now() + kPlainInterval;
}

ProgressDisplay::~ProgressDisplay() { clear(); }

void ProgressDisplay::update(const SessionStatus& status) {
  const auto now = std::chrono::steady_clock::now();
  if (mode_ == ProgressMode::None || now < next_) return;
  const std::string text = progress_text(status);
  if (mode_ == ProgressMode::Plain) {
    next_ = now + kPlainInterval;
    fmt::print(stderr, "{}\n", text);
    return;
  }
  next_ = now + kBarInterval;
  shown_ = true;
  const double share = share_done(status);
  const int room = terminal_width() - static_cast<int>(text.size()) - 12;
  std::string bar;
  if (room >= 10) {
    const int length = std::min(room, 40);
    const int filled = static_cast<int>(std::lround(share * length));
    bar = fmt::format("[{}{}] ", std::string(static_cast<std::size_t>(filled), '#'),
                      std::string(static_cast<std::size_t>(length - filled), '.'));
  }
  fmt::print(stderr, "\r\x1b[K{}{:3.0f} %  {}", bar, 100 * share, text);
  std::fflush(stderr);
}

void ProgressDisplay::clear() {
  if (!shown_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  shown_ = false;
  next_ = {};
}

}  // namespace lightbench
