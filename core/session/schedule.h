#pragma once
// What a session does next, as values: pure functions of counts and measured speed, so that the
// behaviour of an interactive render is tested without rendering anything.

#include <cstdint>
#include <optional>
#include <vector>

namespace lightbench {

/// Whole samples for every pixel of the film, or one sample of a look at lower resolution.
struct Pass {
  int divider = 1;  ///< d > 1: the film of the look is ceil(size / d)
  std::uint32_t first_sample = 0;
  std::uint32_t sample_count = 1;
  bool cancellable = true;  ///< false: finishes although a newer scene waits
  bool operator==(const Pass&) const = default;
};

/// Where a render stands. Speeds are samples (camera paths) per second over all threads, 0 =
/// unknown.
struct Progress {
  int width = 0, height = 0;  ///< of the film, pixels
  bool interactive = false;
  int looked = 0;            ///< divider of this generation's last look or pass, 0 = none yet
  std::uint32_t spp = 0;     ///< samples done
  std::uint32_t target = 0;  ///< samples wanted, 0 = no limit
  double seconds = 0;        ///< rendered so far
  double time_limit = 0;     ///< seconds, 0 = no limit
  double speed = 0;          ///< of full passes
  double look_speed = 0;     ///< of quick looks, which carry more overhead per sample
};

/// The next pass, or nothing when the target or the time limit is reached. Interactive renders
/// start with a look at the divider that fits kLookSeconds, at least 128 pixels on the long axis
/// (Cycles' rule), replaced by the first full pass where that fits too. Finer looks follow, which
/// can be cancelled (finer_divider). Then passes end at 1, 2, 4, 8, ... spp, at each of `stops`,
/// and at the target; none is predicted to last more than a second, since a pass is what an
/// interrupt can lose. At least one sample is taken whatever the time limit.
std::optional<Pass> next_pass(const Progress& progress, const std::vector<int>& stops);

/// Of the first look after an edit; leaves room for the rest of its way to the screen within 20 ms.
inline constexpr double kLookSeconds = 0.012;

/// Divider of a look that is predicted to fit kLookSeconds.
int look_divider(int width, int height, double look_speed);

/// Divider of what follows a look at `divider`: half of it down to 3, then 1. So each picture has
/// about four times the pixels of the one before, and all looks but the first together cost
/// about a fifth of the pass they precede at most.
int finer_divider(int divider);

/// Seconds between published frames once a generation has rendered for `seconds`: quick while the
/// picture changes fast, then ever rarer (Cycles: 0.1 s to 2 s). Headless: 10 s throughout.
double publish_interval(bool interactive, double seconds);

/// Estimated seconds until the target or time limit, < 0 if unknown or unlimited.
double estimate_remaining(const Progress& progress);

/// How a pass is cut into calls of render(): square tiles, and samples per call.
struct Tiling {
  int edge = 32;
  std::uint32_t samples = 1;
  bool operator==(const Tiling&) const = default;
};

/// Calls of at most about 4 ms on one of `threads` threads, so that a cancel is noticed soon. Tiles
/// of the size that loses least: small ones let threads end together, large ones make few calls,
/// each of which ends with lanes that run empty.
/// If pixels have different counts (`uneven`), the tiles are smaller still, and calls four times as
/// short: the busiest tile has many times the samples of the others.
Tiling plan_tiles(int width, int height, std::uint32_t sample_count, int threads, double speed,
                  bool uneven = false);

}  // namespace lightbench
