#include "core/session/session.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "core/scene/change.h"
#include "core/session/coordinator.h"
#include "core/session/exchange.h"

namespace lightbench {

struct Session::State {
  explicit State(const SessionOptions& options)
      : coordinator(exchange, options), thread([this] { coordinator.run(); }) {}

  template <class Edit>
  void request(Edit edit) {
    {
      const std::lock_guard lock(exchange.mutex);
      edit(exchange);
    }
    exchange.coordinator_wake.notify_one();
  }

  Exchange exchange;
  Coordinator coordinator;
  std::thread thread;
};

Session::Session(const SessionOptions& options) : state_(std::make_unique<State>(options)) {}

Session::~Session() {
  state_->request([](Exchange& exchange) { exchange.quit = true; });
  state_->thread.join();
}

std::uint64_t Session::submit(Scene scene) {
  auto next = std::make_shared<const Scene>(std::move(scene));
  // Only this thread writes `newest`, so it may be read here without the lock.
  const std::shared_ptr<const Scene> before = state_->exchange.newest;
  const bool resets = !before || resets_film(diff(*before, *next));
  std::uint64_t generation = 0;
  state_->request([&](Exchange& exchange) {
    exchange.newest = std::move(next);
    exchange.submitted = true;
    if (resets) {
      ++exchange.generation;
      exchange.status.state = SessionState::Compiling;
    } else if (exchange.status.state == SessionState::Finished) {
      exchange.status.state = SessionState::Rendering;  // until the new target is looked at
    }
    generation = exchange.generation;
  });
  return generation;
}

void Session::pause(bool paused) {
  state_->request([paused](Exchange& exchange) {
    exchange.paused = paused;
    exchange.pause_changed = true;
  });
}

void Session::restart() {
  state_->request([](Exchange& exchange) {
    if (!exchange.newest) return;
    ++exchange.generation;
    exchange.submitted = true;
    exchange.status.state = SessionState::Compiling;
  });
}

std::shared_ptr<const Frame> Session::latest() const {
  const std::lock_guard lock(state_->exchange.mutex);
  return state_->exchange.frame;
}

SessionStatus Session::status() const {
  const std::lock_guard lock(state_->exchange.mutex);
  SessionStatus status = state_->exchange.status;
  if (state_->exchange.running_since) {
    const std::chrono::duration<double> running =
        Exchange::Clock::now() - *state_->exchange.running_since;
    status.seconds += running.count();
    if (status.remaining >= 0) status.remaining = std::max(0.0, status.remaining - running.count());
  }
  return status;
}

std::vector<std::shared_ptr<const Frame>> Session::take_snapshots() {
  const std::lock_guard lock(state_->exchange.mutex);
  return std::exchange(state_->exchange.snapshots, {});
}

void Session::request_snapshot() {
  state_->request([](Exchange& exchange) { exchange.snapshot_requested = true; });
}

void Session::wait(std::uint64_t serial, double seconds) const {
  const Exchange& exchange = state_->exchange;
  std::unique_lock lock(exchange.mutex);
  exchange.owner_wake.wait_for(lock, std::chrono::duration<double>(seconds), [&] {
    return (exchange.frame && exchange.frame->serial > serial) || !exchange.snapshots.empty() ||
           exchange.status.state == SessionState::Finished ||
           exchange.status.state == SessionState::Failed;
  });
}

void Session::set_wake(void (*wake)(void*), void* context) {
  const std::lock_guard lock(state_->exchange.mutex);
  state_->exchange.wake = wake;
  state_->exchange.wake_context = context;
}

}  // namespace lightbench
