#include "core/session/schedule.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lightbench {
namespace {

constexpr int kLookLongAxis = 128;
constexpr int kFinestLook = 3;  // at 2 it would cost a quarter of the full pass
constexpr double kPassSeconds = 1.0;
constexpr double kCallSeconds = 0.004;
// Of a call to render(), in samples: cornell-plain in calls of 64 took 1.17 to 1.19 times as long
// as in calls of 4096.
constexpr double kCallOverhead = 12;
// Before anything is measured: slow enough that a slow scene does not block the first picture.
constexpr double kAssumedSpeed = 2e5;
constexpr std::int64_t kMaxSpp = std::numeric_limits<std::uint32_t>::max();

double pixel_count(const Progress& p) {
  return static_cast<double>(p.width) * static_cast<double>(p.height);
}

int round_up_divide(int a, int b) { return (a + b - 1) / b; }

/// Whole spp that fit `seconds`, at least 1.
std::int64_t samples_in(const Progress& p, double seconds) {
  const double spp = p.speed * seconds / pixel_count(p);
  return spp >= static_cast<double>(kMaxSpp) ? kMaxSpp
                                             : std::max<std::int64_t>(1, std::llround(spp - 0.5));
}

}  // namespace

int look_divider(int width, int height, double look_speed) {
  const double budget = (look_speed > 0 ? look_speed : kAssumedSpeed) * kLookSeconds;
  const int coarsest = std::max(1, std::max(width, height) / kLookLongAxis);
  for (int divider = 1; divider < coarsest; ++divider) {
    const double pixels = static_cast<double>(round_up_divide(width, divider)) *
                          static_cast<double>(round_up_divide(height, divider));
    if (pixels <= budget) return divider;
  }
  return coarsest;
}

int finer_divider(int divider) {
  return divider > kFinestLook ? std::max(kFinestLook, (divider + 1) / 2) : 1;
}

std::optional<Pass> next_pass(const Progress& p, const std::vector<int>& stops) {
  const std::int64_t spp = p.spp;
  const std::int64_t target = p.target > 0 ? std::int64_t{p.target} : kMaxSpp;
  if (spp >= target) return std::nullopt;
  if (p.interactive && p.looked == 0 && spp == 0) {
    const int divider = look_divider(p.width, p.height, p.look_speed > 0 ? p.look_speed : p.speed);
    return Pass{.divider = divider, .first_sample = 0, .sample_count = 1, .cancellable = false};
  }
  if (p.interactive && p.looked > 1 && spp == 0) {
    const int divider = finer_divider(p.looked);
    if (divider > 1) return Pass{.divider = divider, .first_sample = 0, .sample_count = 1};
  }
  auto end = std::min(
      target, static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(spp)) * 2));
  if (spp == 0) end = 1;
  for (const int stop : stops) {
    if (stop > spp) end = std::min<std::int64_t>(end, stop);
  }
  // In a window a pass also ends when a new picture is due.
  double longest = kPassSeconds;
  if (p.interactive) longest = std::clamp(publish_interval(true, p.seconds), 0.1, kPassSeconds);
  if (p.time_limit > 0 && spp > 0) {
    const double left = p.time_limit - p.seconds;
    if (left <= 0) return std::nullopt;
    // One more sample that would end far beyond the limit is not started.
    if (p.speed > 0 && pixel_count(p) / p.speed > 1.5 * left) return std::nullopt;
    longest = std::min(longest, left);
  }
  if (p.speed > 0) end = std::min(end, spp + samples_in(p, longest));
  return Pass{.divider = 1,
              .first_sample = p.spp,
              .sample_count = static_cast<std::uint32_t>(end - spp),
              .cancellable = true};
}

double publish_interval(bool interactive, double seconds) {
  if (!interactive) return 10;
  if (seconds < 0.3) return 0.03;
  if (seconds < 1) return 0.1;
  if (seconds < 2) return 0.25;
  if (seconds < 4) return 0.5;
  if (seconds < 8) return 1;
  return 2;
}

double estimate_remaining(const Progress& p) {
  double remaining = -1;
  if (p.target > 0 && p.spp >= p.target) return 0;
  if (p.target > 0 && p.speed > 0) {
    remaining = static_cast<double>(p.target - p.spp) * pixel_count(p) / p.speed;
  }
  if (p.time_limit > 0) {
    const double left = std::max(0.0, p.time_limit - p.seconds);
    remaining = remaining < 0 ? left : std::min(remaining, left);
  }
  return remaining;
}

Tiling plan_tiles(int width, int height, std::uint32_t sample_count, int threads, double speed,
                  bool uneven) {
  const double call_seconds = uneven ? kCallSeconds / 4 : kCallSeconds;
  const double per_call =
      std::max(64.0, (speed > 0 ? speed : kAssumedSpeed) / threads * call_seconds);
  Tiling tiling{uneven ? 16 : 64, 1};
  // Share of the pass that is lost: by lanes that run empty as calls end, and by threads that wait
  // for the last tile.
  const auto loss = [&](int edge) {
    const double pixels = edge * edge;
    return kCallOverhead / std::min(pixels * sample_count, per_call) +
           0.5 * threads * pixels / (static_cast<double>(width) * height);
  };
  while (tiling.edge > 8 &&
         (tiling.edge * tiling.edge > per_call || loss(tiling.edge / 2) < loss(tiling.edge))) {
    tiling.edge /= 2;
  }
  const double samples = std::floor(per_call / (tiling.edge * tiling.edge));
  tiling.samples = static_cast<std::uint32_t>(
      std::clamp(samples, 1.0, static_cast<double>(std::max(1U, sample_count))));
  return tiling;
}

}  // namespace lightbench
