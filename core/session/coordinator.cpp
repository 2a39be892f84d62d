#include "core/session/coordinator.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/scene/change.h"
#include "core/session/priority.h"

namespace lightbench {
namespace {

/// Recent speed counts more, one odd pass does not rule.
double blend(double before, double now) { return before > 0 ? 0.5 * (before + now) : now; }

bool contains(const std::vector<int>& counts, std::uint32_t spp) {
  return std::any_of(counts.begin(), counts.end(), [spp](int count) {
    return count > 0 && static_cast<std::uint32_t>(count) == spp;
  });
}

int round_up_divide(int a, int b) { return (a + b - 1) / b; }

void resize(Film& film, int width, int height, double unit) {
  if (film.width() != width || film.height() != height || film.unit() != unit) {
    film = Film();  // give the memory back first
    film = Film(width, height, unit);
  }
}

std::uint64_t bytes(const Film& film) { return film.pixels().size() * sizeof(FilmPixel); }

}  // namespace

Coordinator::Coordinator(Exchange& exchange, const SessionOptions& options)
    : exchange_(exchange),
      options_(options),
      pool_(thread_count(options.threads), options.low_priority, [&exchange] {
        {
          const std::lock_guard lock(exchange.mutex);
          exchange.pass_done = true;
        }
        exchange.coordinator_wake.notify_one();
      }) {
  const std::lock_guard lock(exchange.mutex);
  exchange.status.threads = pool_.threads();
}

void Coordinator::run() {
  react_promptly();
  for (;;) {
    const Requests requests = take_requests();
    if (requests.quit) return;
    try {
      accept(requests);
      if (requests.pass_done) finish_pass();
      if (running_) continue;
      if (pending_) adopt_pending();
      publish_due();
      start_next();
    } catch (const std::exception& e) {
      fail(e.what());
    }
  }
}

Coordinator::Requests Coordinator::take_requests() {
  std::unique_lock lock(exchange_.mutex);
  exchange_.coordinator_wake.wait(lock, [this] {
    return exchange_.quit || exchange_.submitted || exchange_.pause_changed ||
           exchange_.snapshot_requested || exchange_.pass_done;
  });
  Requests requests;
  requests.quit = exchange_.quit;
  if (std::exchange(exchange_.submitted, false)) requests.scene = exchange_.newest;
  requests.generation = exchange_.generation;
  requests.snapshot = std::exchange(exchange_.snapshot_requested, false);
  requests.pass_done = std::exchange(exchange_.pass_done, false);
  exchange_.pause_changed = false;
  paused_ = exchange_.paused;
  return requests;
}

void Coordinator::accept(const Requests& requests) {
  if (requests.snapshot) snapshot_wanted_ = true;
  if (requests.scene && requests.generation != generation_) {
    pending_ = requests.scene;
    pending_generation_ = requests.generation;
    if (running_ && running_->cancellable) pool_.cancel();
  } else if (requests.scene) {
    // Only target or display differ from the scene in work, which goes on.
    if (error_.empty()) scene_ = requests.scene;
  }
  if (running_) {
    // A snapshot needs whole passes: it lets a held pass end first.
    const bool held = paused_ && running_->cancellable && !snapshot_wanted_;
    pool_.hold(held);
    run_clock(!held);
    report(held ? SessionState::Paused : SessionState::Rendering);
  }
}

void Coordinator::finish_pass() {
  const Pass pass = *std::exchange(running_, std::nullopt);
  const JobResult result = pool_.result();
  if (!result.complete) {  // else a newer scene made it worthless
    if (!result.error.empty() && !pending_) fail(result.error);
    return;
  }
  const double took = std::max(1e-6, seconds() - pass_started_);
  const double speed = static_cast<double>(result.counters.paths) / took;
  looked_ = pass.divider;
  if (pass.divider > 1) {
    look_speed_ = blend(look_speed_, speed);
    published_at_ = seconds();
    publish(make_look(), false);
    return;
  }
  if (!pass.cancellable) look_speed_ = blend(look_speed_, speed);
  speed_ = blend(speed_, speed);
  spp_ += pass.sample_count;
  counters_ += result.counters;
  pass_seconds_ += took;
  samples_per_second_ = static_cast<double>(counters_.paths) / pass_seconds_;
  rays_per_second_ = static_cast<double>(counters_.rays + counters_.shadow_rays) / pass_seconds_;
}

void Coordinator::adopt_pending() {
  const std::shared_ptr<const Scene> next_scene = std::exchange(pending_, nullptr);
  run_clock(false);
  generation_ = pending_generation_;
  error_.clear();
  looked_ = 0;
  spp_ = published_spp_ = snapshot_spp_ = 0;
  samples_ = {};
  counters_ = {};
  pass_seconds_ = clock_seconds_ = published_at_ = 0;
  report(SessionState::Compiling);
  const Change change = scene_ ? diff(*scene_, *next_scene) : Change::All;
  if (!compiled_ || resets_film(change)) {
    compiled_ = compile(*next_scene, options_.kernel, compiled_.get(), change);
  }
  scene_ = next_scene;
  resize_films();
}

void Coordinator::resize_films() {
  const Crop& crop = compiled_->crop;
  resize(film_, crop.width, crop.height, compiled_->film_unit);
  plan_ = {};  // give the memory back first
  if (scene_->render.adaptive) plan_ = SamplePlan(crop.width, crop.height);
}

/// Whether a picture of `spp` samples, complete at `time`, is to be published.
bool Coordinator::is_due(std::uint32_t spp, double time) const {
  if (published_spp_ == 0 || contains(scene_->render.snapshots, spp)) return true;
  const auto target = static_cast<std::uint32_t>(std::max(0, scene_->render.spp));
  return spp == target || time - published_at_ >= publish_interval(options_.interactive, time);
}

void Coordinator::publish_due() {
  if (spp_ == 0 || !error_.empty()) return;
  const bool at_stop = snapshot_spp_ != spp_ && contains(scene_->render.snapshots, spp_);
  const bool is_snapshot = at_stop || snapshot_wanted_;
  if (!is_snapshot && (published_spp_ == spp_ || !(is_due(spp_, seconds()) || !next()))) return;
  publish(make_frame(is_snapshot), is_snapshot);
  published_spp_ = spp_;
  published_at_ = seconds();
  if (is_snapshot) snapshot_spp_ = spp_;
  snapshot_wanted_ = false;
}

void Coordinator::start_next() {
  if (!compiled_ || !error_.empty()) return;
  const std::optional<Pass> pass = next();
  if (!pass || (paused_ && pass->cancellable)) {
    run_clock(false);
    return report(pass ? SessionState::Paused : SessionState::Finished);
  }
  Film& film = pass->divider > 1 ? look_ : film_;
  if (pass->divider > 1) {
    resize(look_, round_up_divide(film_.width(), pass->divider),
           round_up_divide(film_.height(), pass->divider), compiled_->film_unit);
  }
  run_clock(true);
  report(SessionState::Rendering);
  pass_started_ = seconds();
  const bool adaptive = plan_.on() && pass->divider == 1;
  const bool uneven = adaptive && spp_ >= kUniformSpp;
  // At powers of two, where passes end, a round is complete and nothing of the next is there.
  if (uneven && std::has_single_bit(spp_)) plan_.begin_round(spp_, film_);
  running_ = pass;
  pool_.hold(false);
  pool_.start({compiled_, film.view(), film.height(), *pass,
               plan_tiles(film.width(), film.height(), pass->sample_count, pool_.threads(),
                          speed_ > 0 ? speed_ : look_speed_, uneven),
               uneven ? &plan_ : nullptr, means_after(*pass)});
  // The memory of the next picture is made while the workers trace.
  if (options_.interactive) make_room_for_means();
}

/// Where the workers write the means after `pass`; null if it is hardly to be published.
float* Coordinator::means_after(const Pass& pass) {
  means_spp_ = 0;
  if (pass.divider > 1) return nullptr;
  const std::uint32_t spp = spp_ + pass.sample_count;
  const double samples = static_cast<double>(pass.sample_count) * film_.width() * film_.height();
  const double end = speed_ > 0 ? seconds() + samples / speed_ : seconds();
  if (!snapshot_wanted_ && speed_ > 0 && !is_due(spp, end)) return nullptr;
  make_room_for_means();
  means_spp_ = spp;
  return means_.rgb.data();
}

void Coordinator::make_room_for_means() {
  if (means_.width == film_.width() && means_.height == film_.height()) return;
  means_ = {};  // give the memory back first
  means_ = {film_.width(), film_.height(), std::vector<float>(3 * film_.pixels().size())};
}

void Coordinator::fail(const std::string& error) {
  error_ = error;
  run_clock(false);
  report(SessionState::Failed);
}

std::shared_ptr<const Frame> Coordinator::make_look() {
  const std::shared_ptr<Frame> frame = new_frame(1, look_.mean(1));
  frame->divider = looked_;
  return frame;
}

std::shared_ptr<const Frame> Coordinator::make_frame(bool with_variance) {
  samples_ = plan_.on() ? plan_.extent(spp_) : SampleExtent{spp_, spp_};
  const bool made = means_spp_ == spp_;
  means_spp_ = 0;
  const std::shared_ptr<Frame> frame =
      new_frame(spp_, made ? std::exchange(means_, {}) : picture());
  if (with_variance) {
    frame->variance = plan_.on() ? plan_.variance(film_, spp_) : film_.variance(spp_);
  }
  return frame;
}

Image Coordinator::picture() const {
  if (!plan_.on()) return film_.mean(spp_);
  const std::size_t size = film_.pixels().size();
  Image image{film_.width(), film_.height(), std::vector<float>(3 * size)};
  plan_.write_means(film_.pixels().data(), 0, size, film_.unit(), spp_, image.rgb.data());
  return image;
}

std::shared_ptr<Frame> Coordinator::new_frame(std::uint32_t spp, Image image) {
  auto frame = std::make_shared<Frame>();
  frame->image = std::move(image);
  frame->spp = spp;
  frame->seconds = seconds();
  frame->generation = generation_;
  frame->serial = ++serial_;
  frame->scene = compiled_;
  return frame;
}

void Coordinator::publish(std::shared_ptr<const Frame> frame, bool is_snapshot) {
  void (*wake)(void*) = nullptr;
  void* context = nullptr;
  {
    const std::lock_guard lock(exchange_.mutex);
    if (is_snapshot) exchange_.snapshots.push_back(frame);
    exchange_.frame.swap(frame);  // the old frame is freed below, outside the lock
    exchange_.status.spp = spp_;  // the rest of the status follows; this is never behind
    wake = exchange_.wake;
    context = exchange_.wake_context;
  }
  exchange_.owner_wake.notify_all();
  if (wake) wake(context);
}

void Coordinator::run_clock(bool running) {
  if (running == clock_since_.has_value()) return;
  if (running) {
    clock_since_ = Exchange::Clock::now();
  } else {
    clock_seconds_ = seconds();
    clock_since_.reset();
  }
}

double Coordinator::seconds() const {
  if (!clock_since_) return clock_seconds_;
  const std::chrono::duration<double> running = Exchange::Clock::now() - *clock_since_;
  return clock_seconds_ + running.count();
}

void Coordinator::report(SessionState state) {
  SessionStatus status;
  status.state = state;
  status.generation = generation_;
  status.spp = spp_;
  status.samples = samples_;
  status.seconds = clock_seconds_;
  status.samples_per_second = samples_per_second_;
  status.rays_per_second = rays_per_second_;
  status.counters = counters_;
  status.film_bytes = bytes(film_) + plan_.bytes() + bytes(look_);
  status.threads = pool_.threads();
  status.error = error_;
  if (scene_) {
    status.target_spp = static_cast<std::uint32_t>(std::max(0, scene_->render.spp));
    status.remaining = estimate_remaining(progress());
    if (status.remaining >= 0) status.remaining += seconds() - clock_seconds_;
  }
  if (compiled_) status.scene = compiled_->stats;
  bool changed = false;
  void (*wake)(void*) = nullptr;
  void* context = nullptr;
  {
    const std::lock_guard lock(exchange_.mutex);
    // A scene submitted meanwhile is not finished, whatever became of the one before.
    if (exchange_.submitted && exchange_.generation != generation_) {
      status.state = SessionState::Compiling;
    } else if (exchange_.submitted && state == SessionState::Finished) {
      status.state = SessionState::Rendering;
    }
    changed = exchange_.status.state != status.state;
    exchange_.status = std::move(status);
    exchange_.running_since = clock_since_;
    wake = exchange_.wake;
    context = exchange_.wake_context;
  }
  if (!changed) return;
  exchange_.owner_wake.notify_all();
  if (wake) wake(context);
}

Progress Coordinator::progress() const {
  const RenderSettings& settings = scene_->render;
  return {.width = film_.width(),
          .height = film_.height(),
          .interactive = options_.interactive,
          .looked = looked_,
          .spp = spp_,
          .target = static_cast<std::uint32_t>(std::max(0, settings.spp)),
          .seconds = seconds(),
          .time_limit = settings.time_limit,
          .speed = speed_,
          .look_speed = look_speed_};
}

std::optional<Pass> Coordinator::next() const {
  return next_pass(progress(), scene_->render.snapshots);
}

}  // namespace lightbench
