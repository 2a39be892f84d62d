#include "app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"

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
    text += fmt::format("  {}samples/s", format_count(status.samples_per_second));
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

std::string format_duration(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string format_count(double value) {
  const char* prefixes[] = {"", "k", "M", "G", "T"};
  std::size_t i = 0;
  for (; value >= 999.5 && i + 1 < std::size(prefixes); ++i) value /= 1000;
  return fmt::format("{:.{}f} {}", value, i > 0 && value < 99.95 ? 1 : 0, prefixes[i]);
}

std::string format_bytes(double bytes) {
  const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t i = 0;
  for (; bytes >= 1023.5 && i + 1 < std::size(units); ++i) bytes /= 1024;
  return fmt::format("{:.{}f} {}", bytes, i > 0 && bytes < 99.95 ? 1 : 0, units[i]);
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
