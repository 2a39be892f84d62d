// lightbench render: a scene to pictures, without a window.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <memory>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/output_names.h"
#include "app/parse.h"
#include "app/path_text.h"
#include "app/progress.h"
#include "app/render_report.h"
#include "app/scene_options.h"
#include "app/version.h"
#include "core/error.h"
#include "core/film/image_file.h"
#include "core/format.h"
#include "core/query/path.h"
#include "core/query/replay.h"
#include "core/scene/file.h"
#include "core/session/session.h"

namespace lightbench {
namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string spp;
  std::vector<std::string> outputs;
  std::string time_limit;
  std::string stats_json;
  std::string progress;
  std::string debug_sample;
};

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &parts);
  return text;
}

/// Sets target, time limit and the counts at which pictures are written.
void apply_targets(const RenderOptions& options, Scene& scene) {
  RenderSettings& render = scene.render;
  if (!options.time_limit.empty()) {
    render.time_limit = parse_duration("--time-limit", options.time_limit);
  }
  if (!options.spp.empty()) {
    render.snapshots = parse_counts("--spp", options.spp);
    render.spp = render.snapshots.empty() ? 0 : render.snapshots.back();
  } else {
    // The scene's own list needs names that tell its pictures apart.
    const bool named = std::all_of(options.outputs.begin(), options.outputs.end(), [](auto& name) {
      return name.find("{spp}") != std::string::npos;
    });
    if (!named) render.snapshots.clear();
    std::erase_if(render.snapshots,
                  [&](int count) { return render.spp > 0 && count > render.spp; });
    if (render.spp > 0) render.snapshots.push_back(render.spp);
  }
  if (render.spp == 0 && render.time_limit <= 0) {
    throw Error(ErrorKind::Usage,
                "--spp: the scene sets no limit; expected --spp N or --time-limit TIME");
  }
}

/// Writes frames under the names that the user asked for.
class Saver {
 public:
  Saver(const RenderOptions& options, const Scene& scene) : options_(options), scene_(scene) {
    fields_.scene = std::filesystem::path(options.scene.file).stem().string();
    fields_.seed = scene.render.seed;
    fields_.width = scene.render.crop.width > 0 ? scene.render.crop.width : scene.render.width;
    fields_.height = scene.render.crop.width > 0 ? scene.render.crop.height : scene.render.height;
    fields_.time = local_time();
  }

  /// Throws if any name that this render will use is bad, before it starts.
  void check() const {
    std::vector<int> counts = scene_.render.snapshots;
    std::sort(counts.begin(), counts.end());
    counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
    if (counts.empty()) counts = {1};  // ended by time, at a count known only then
    check_outputs(options_.outputs, counts, fields_);
  }

  void save(const Frame& frame, bool partial) {
    fields_.spp = frame.spp;
    const ImageMetadata metadata = {
        {"Software", "lightbench " + version_number()},
        {"Scene", options_.scene.file},
        {"samplesPerPixel", std::to_string(frame.spp)},
        {"renderTimeSeconds", fmt::format("{:.3f}", frame.seconds)},
        {"seed", std::to_string(scene_.render.seed)},
    };
    for (const std::string& pattern : options_.outputs) {
      std::filesystem::path name = output_name(pattern, fields_);
      if (partial) name = partial_name(name);
      write_image(name, frame.image, scene_.display, metadata, frame.variance);
      fmt::print("{}  {} spp  {}\n", name.string(), frame.spp, format_duration(frame.seconds));
      std::fflush(stdout);
      pictures_.push_back({name, frame.spp, frame.seconds});
    }
  }

  [[nodiscard]] const std::vector<SavedPicture>& pictures() const { return pictures_; }
  [[nodiscard]] std::uint32_t last_spp() const {
    return pictures_.empty() ? 0 : pictures_.back().spp;
  }

 private:
  const RenderOptions& options_;
  const Scene& scene_;
  OutputFields fields_;
  std::vector<SavedPicture> pictures_;
};

/// All samples so far, or the last published picture if the pass in work takes long; may be null.
std::shared_ptr<const Frame> picture_so_far(Session& session) {
  session.request_snapshot();
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  std::uint64_t serial = session.latest() ? session.latest()->serial : 0;
  while (std::chrono::steady_clock::now() < give_up) {
    if (auto snapshots = session.take_snapshots(); !snapshots.empty()) return snapshots.back();
    session.wait(serial, 0.05);
    if (const auto frame = session.latest()) serial = frame->serial;
  }
  return session.latest();
}

/// Runs until finished, failed or interrupted; pictures are written as their counts are reached.
void run(Session& session, Saver& saver, ProgressMode mode) {
  ProgressDisplay progress(mode);
  std::uint64_t serial = 0;
  for (;;) {
    session.wait(serial, 0.1);
    if (const auto frame = session.latest()) serial = frame->serial;
    const SessionStatus status = session.status();
    if (status.state == SessionState::Failed) throw Error(ErrorKind::Scene, status.error);
    for (const auto& snapshot : session.take_snapshots()) {
      progress.clear();
      saver.save(*snapshot, false);
    }
    if (status.state == SessionState::Finished || interrupt_signal() != 0) return;
    progress.update(status);
  }
}

/// Prints the path of one sample instead of rendering.
int print_sample(const RenderOptions& options) {
  const SampleName name = parse_sample("--debug-sample", options.debug_sample);
  const KernelKind kernel = chosen_kernel(options.scene);
  const Scene scene = load_scene(options.scene);
  const auto compiled = compile(scene, kernel);
  fmt::print("{}", path_text(scene, *compiled, name, trace_path(*compiled, name)));
  return 0;
}

int render_scene(const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const ProgressMode mode = parse_progress(options.progress);
  SessionOptions session_options;
  session_options.kernel = chosen_kernel(options.scene);
  session_options.threads = chosen_threads(options.scene);
  Scene scene = load_scene(options.scene);
  apply_targets(options, scene);
  Saver saver(options, scene);
  saver.check();
  if (!options.stats_json.empty()) check_writable(options.stats_json);

  catch_interrupts();
  Session session(session_options);
  session.submit(scene);
  run(session, saver, mode);

  RenderReport report;
  const int signal = interrupt_signal();
  if (signal != 0) session.pause(true);
  report.status = session.status();
  const bool reached = scene.render.spp > 0
                           ? report.status.spp >= static_cast<std::uint32_t>(scene.render.spp)
                           : report.status.state == SessionState::Finished;
  const bool interrupted = signal != 0 && !reached;
  if (saver.last_spp() != report.status.spp || interrupted) {
    const auto frame = picture_so_far(session);
    if (frame && frame->spp != saver.last_spp()) saver.save(*frame, interrupted);
    if (!frame) fmt::print(stderr, "lightbench: stopped before the first sample, nothing saved\n");
    report.status = session.status();
  }
  report.scene_file = options.scene.file;
  report.kernel = kernel_name(report.status.scene.kernel);
  report.stopped_by = interrupted                       ? (signal == SIGINT ? "SIGINT" : "SIGTERM")
                      : scene.render.spp > 0 && reached ? "target"
                                                        : "time limit";
  report.pictures = saver.pictures();
  report.replay = replay_command(options.scene.file, scene.render, report.kernel,
                                 report.status.counters.bad, options.scene.definitions);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  report.wall_seconds = wall.count();
  fmt::print("{}", summary(report));
  if (!options.stats_json.empty()) {
    replace_file(options.stats_json, stats_json(report, scene));
  }
  if (interrupted) return 128 + signal;
  return reached ? 0 : kExitStoppedByLimit;
}

}  // namespace

void add_render(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App& command = *app.add_subcommand("render", "Render a scene to image files");
  add_scene_options(command, options->scene, SceneArgument::Required);
  command
      .add_option("-s,--spp,--samples", options->spp,
                  "Samples per pixel; with a list, a picture at each count")
      ->type_name("N[,N...]");
  command
      .add_option("-o,--output", options->outputs,
                  "Picture to write: .png .exr .hdr .pfm .ppm; fields {scene} {spp} {seed} {width} "
                  "{height} {time}; may be repeated (default: {scene}-{spp}.png)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      .add_option("--time-limit", options->time_limit,
                  "Stop after this render time, keep the picture (exit code 5)")
      ->type_name("TIME");
  command.add_option("--stats-json", options->stats_json, "Write statistics to a JSON file")
      ->type_name("FILE");
  command
      .add_option("--progress", options->progress,
                  "bar, plain or none (default: bar on a terminal, else plain)")
      ->type_name("MODE");
  command
      .add_option("--debug-sample", options->debug_sample,
                  "Print the path of one sample instead: pixel x, y from the top left, sample k")
      ->type_name("X,Y,K");
  command.callback([options, &action] {
    if (options->outputs.empty()) options->outputs = {"{scene}-{spp}.png"};
    action = [options] {
      return options->debug_sample.empty() ? render_scene(*options) : print_sample(*options);
    };
  });
}

}  // namespace lightbench
