// lightbench bench: error against time, for scenes with a stored reference.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/bench/report.h"
#include "app/commands.h"
#include "app/output_names.h"
#include "app/parse.h"
#include "app/progress.h"
#include "app/scene_options.h"
#include "core/error.h"
#include "core/format.h"
#include "core/scene/file.h"
#include "core/session/worker_pool.h"

namespace lightbench {
namespace {

/// Pictures are scaled down to this many pixels on their long side unless --resolution says
/// otherwise, so that references are small and runs many.
constexpr int kBenchSize = 150;

struct BenchOptions {
  SceneOptions scene;
  std::vector<std::string> files;
  std::string references = "scenes/references";
  std::string kernels, time = "10s", json, html, progress;
  std::vector<std::string> ab;
  std::string reference_time = "1h";
  double reference_error = 1e-4;
  bool make_references = false;
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(',', begin)) != std::string::npos; begin = end + 1) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

/// The scenes that were named, or all in scenes/ that have a reference.
std::vector<std::string> scene_files(const BenchOptions& options) {
  if (!options.files.empty()) return options.files;
  std::vector<std::string> files;
  std::error_code code;
  for (const auto& entry : std::filesystem::directory_iterator("scenes", code)) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() == ".json" &&
        std::filesystem::exists(bench::reference_file(options.references, file))) {
      files.push_back(file.generic_string());
    }
  }
  if (files.empty()) {
    throw Error(ErrorKind::Usage, fmt::format("no scene given, and none in scenes/ has a reference "
                                              "in {}; expected lightbench bench SCENE...",
                                              options.references));
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// One line that tells how far things are, rewritten on a terminal.
class Status {
 public:
  explicit Status(ProgressMode mode) : mode_(mode) {}
  ~Status() { clear(); }
  Status(const Status&) = delete;
  Status& operator=(const Status&) = delete;

  void show(const std::string& text) {
    if (mode_ == ProgressMode::Bar) {
      fmt::print(stderr, "\r\033[K{}", text);
      std::fflush(stderr);
      shown_ = true;
    } else if (mode_ == ProgressMode::Plain) {
      const auto now = std::chrono::steady_clock::now();
      if (now < next_) return;
      next_ = now + std::chrono::seconds(5);
      fmt::print(stderr, "{}\n", text);
    }
  }
  void clear() {
    if (shown_) fmt::print(stderr, "\r\033[K");
    shown_ = false;
  }

 private:
  ProgressMode mode_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_{};
};

Scene bench_scene(const BenchOptions& options, const std::string& file,
                  const std::vector<std::string>& definitions = {}) {
  SceneOptions scene_options = options.scene;
  scene_options.file = file;
  scene_options.definitions.insert(scene_options.definitions.end(), definitions.begin(),
                                   definitions.end());
  Scene scene = load_scene(scene_options);
  RenderSettings& render = scene.render;
  if (render.adaptive) {
    throw Error(
        ErrorKind::Usage,
        "--adaptive: a benchmark's errors are those of equal counts; expected adaptive off");
  }
  const int longest = std::max(render.width, render.height);
  if (options.scene.resolution.empty() && options.scene.crop.empty() && longest > kBenchSize) {
    render.width = std::max(1, render.width * kBenchSize / longest);
    render.height = std::max(1, render.height * kBenchSize / longest);
    render.crop = {};
  }
  return scene;
}

/// One --ab: a setting and the values that it is given in turn.
struct Variation {
  std::string key;
  std::vector<std::string> values;
};

Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  Variation v{text.substr(0, equals), {}};
  if (equals != std::string::npos) v.values = split(text.substr(equals + 1));
  if (v.values.size() < 2 || !(v.key.starts_with("/") || v.key == "kernel" || v.key == "threads")) {
    throw Error(ErrorKind::Usage,
                fmt::format("--ab '{}': expected kernel=A,B, threads=A,B or /POINTER=A,B", text));
  }
  return v;
}

/// The subject with the k-th value of each variation.
bench::Subject varied(const BenchOptions& options, const std::string& file,
                      const std::vector<Variation>& variations, std::size_t k) {
  bench::Subject subject{
      "", {}, chosen_kernel(options.scene), thread_count(chosen_threads(options.scene))};
  std::vector<std::string> definitions;
  for (const Variation& v : variations) {
    const std::string text = v.key + "=" + v.values[k];
    subject.name += (subject.name.empty() ? "" : " ") + text;
    if (v.key == "kernel") {
      subject.kernel = parse_kernel("--ab kernel", v.values[k]);
    } else if (v.key == "threads") {
      SceneOptions with_threads = options.scene;
      with_threads.threads = v.values[k];
      subject.threads = thread_count(chosen_threads(with_threads));
    } else {
      definitions.push_back(text);
    }
  }
  subject.scene = bench_scene(options, file, definitions);
  return subject;
}

/// What is measured against each other.
std::vector<bench::Subject> subjects(const BenchOptions& options, const std::string& file) {
  std::vector<bench::Subject> list;
  if (!options.ab.empty()) {
    std::vector<Variation> variations;
    for (const std::string& text : options.ab) {
      variations.push_back(parse_variation(text));
      if (variations.back().values.size() != variations[0].values.size()) {
        throw Error(ErrorKind::Usage,
                    fmt::format("--ab '{}': expected {} values, as many as '{}' has", text,
                                variations[0].values.size(), options.ab[0]));
      }
    }
    for (std::size_t k = 0; k < variations[0].values.size(); ++k) {
      list.push_back(varied(options, file, variations, k));
    }
    return list;
  }
  const int threads = thread_count(chosen_threads(options.scene));
  const Scene scene = bench_scene(options, file);
  for (const std::string& kernel :
       split(options.kernels.empty() ? options.scene.kernel : options.kernels)) {
    list.push_back({kernel, scene, parse_kernel("--kernels", kernel), threads});
  }
  return list;
}

void make_references(const BenchOptions& options) {
  Status status(parse_progress(options.progress));
  bench::ReferenceGoal goal;
  goal.relmse = options.reference_error;
  goal.seconds = parse_duration("--reference-time", options.reference_time);
  goal.threads = thread_count(chosen_threads(options.scene));
  for (const std::string& file : scene_files(options)) {
    const Scene scene = bench_scene(options, file);
    const auto target = bench::reference_file(options.references, file);
    check_writable(target);
    const bench::Reference reference =
        bench::make_reference(scene, goal, [&](double share, double relmse, double seconds) {
          status.show(fmt::format("{}: reference {:.0f} %, relMSE {:.2g}, {} left", file,
                                  100 * std::min(1.0, share), relmse,
                                  format_duration(seconds / share - seconds)));
        });
    bench::save_reference(target, reference, file);
    status.clear();
    fmt::print("{}  {} spp  relMSE {:.2g}\n", target.string(), reference.spp, reference.relmse);
    std::fflush(stdout);
  }
}

int run_bench(const BenchOptions& options) {
  if (!options.scene.seed.empty()) {
    throw Error(ErrorKind::Usage, "--seed: every run of a benchmark has a seed of its own");
  }
  if (!options.ab.empty() && !options.kernels.empty()) {
    throw Error(ErrorKind::Usage, "--kernels: not with --ab; expected one of the two, or --kernel");
  }
  if (options.make_references) {
    make_references(options);
    return 0;
  }
  const double seconds = parse_duration("--time", options.time);
  const ProgressMode mode = parse_progress(options.progress);
  for (const std::string& file : {options.json, options.html}) {
    if (!file.empty()) check_writable(file);
  }
  // Everything is read, and refused if wrong, before the first is rendered.
  struct Plan {
    std::string file;
    std::vector<bench::Subject> subjects;
    bench::Reference reference;
  };
  std::vector<Plan> plans;
  for (const std::string& file : scene_files(options)) {
    Plan plan{file, subjects(options, file), {}};
    const auto reference = bench::reference_file(options.references, file);
    for (const bench::Subject& subject : plan.subjects) {
      plan.reference = bench::load_reference(reference, subject.scene, file);
    }
    plans.push_back(std::move(plan));
  }
  Status status(mode);
  std::vector<bench::Measurement> measurements;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const Plan& plan = plans[i];
    measurements.push_back(
        bench::measure(plan.file, plan.reference, plan.subjects, seconds,
                       [&](std::size_t done, std::size_t all, double left) {
                         // The scenes still to come take about what was asked for.
                         double later = 0;
                         for (std::size_t k = i + 1; k < plans.size(); ++k)
                           later += seconds * static_cast<double>(plans[k].subjects.size());
                         status.show(fmt::format("{}: run {} of {}, {} left", plan.file, done + 1,
                                                 all, format_duration(left + later)));
                       }));
    status.clear();
    fmt::print("{}", bench::table(measurements.back()));
    std::fflush(stdout);
  }
  if (!options.json.empty()) {
    replace_file(options.json, bench::to_json(measurements).dump(2) + "\n");
  }
  if (!options.html.empty()) replace_file(options.html, bench::page(measurements));
  return 0;
}

}  // namespace

void add_bench(CLI::App& app, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App& command = *app.add_subcommand(
      "bench", "Measure error against time, by many short renders against a stored reference");
  command
      .add_option("SCENES", options->files,
                  "Scene files (default: those in scenes/ that have a reference)")
      ->type_name("FILE...");
  command.add_option("--time", options->time, "Rendering time for each scene and setting (10s)")
      ->type_name("TIME");
  command.add_option("--kernels", options->kernels, "Compare builds of the tracer: avx512,avx2")
      ->type_name("NAME[,NAME...]");
  command
      .add_option("--ab", options->ab,
                  "Compare settings in turn, run by run: kernel=A,B, threads=A,B, /POINTER=A,B; "
                  "repeated, the first values go together, the second, ...")
      ->type_name("NAME=A,B[,C...]")
      ->allow_extra_args(false);
  command.add_option("--json", options->json, "Write all figures")->type_name("FILE");
  command.add_option("--html", options->html, "Write a page with plots and maps")
      ->type_name("FILE");
  command.add_option("--references", options->references, "Folder of the references")
      ->type_name("FOLDER")
      ->capture_default_str();
  command.add_flag("--make-references", options->make_references,
                   "Render the references of these scenes instead");
  command
      .add_option("--reference-error", options->reference_error,
                  "relMSE that a reference may have itself")
      ->type_name("X")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--reference-time", options->reference_time,
                  "End a reference after this time, however far it is (1h)")
      ->type_name("TIME");
  command
      .add_option("--progress", options->progress,
                  "bar, plain or none (default: bar on a terminal, else plain)")
      ->type_name("MODE");
  add_scene_options(command, options->scene, SceneArgument::Separate);
  command.callback([options, &action] { action = [options] { return run_bench(*options); }; });
}

}  // namespace lightbench
