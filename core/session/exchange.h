#pragma once
// All that a session's owner thread and its coordinator share.

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "core/film/frame.h"
#include "core/scene/scene.h"
#include "core/session/session.h"

namespace lightbench {

/// `mutex` guards every other field and is only ever held to swap values in or out.
struct Exchange {
  using Clock = std::chrono::steady_clock;

  mutable std::mutex mutex;
  std::condition_variable coordinator_wake;
  mutable std::condition_variable owner_wake;

  // What the owner wants.
  std::shared_ptr<const Scene> newest;  ///< null before the first submit
  std::uint64_t generation = 0;         ///< of `newest`; grows when its samples are worth nothing
  bool submitted = false;               ///< `newest` or `generation` changed
  bool paused = false;
  bool pause_changed = false;
  bool snapshot_requested = false;
  bool quit = false;
  void (*wake)(void*) = nullptr;
  void* wake_context = nullptr;

  bool pass_done = false;  ///< from the workers

  // What the coordinator has.
  std::shared_ptr<const Frame> frame;
  std::vector<std::shared_ptr<const Frame>> snapshots;
  SessionStatus status;  ///< `seconds` and `remaining` as of the last start or stop of the clock
  std::optional<Clock::time_point> running_since;
};

}  // namespace lightbench
