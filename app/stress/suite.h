#pragma once
// The stability suite: what a test is, what it counts, and how a run of it is put together.
//
// A test is a distribution of questions that are put to a compiled scene through core/query, and
// judged by an oracle of its own. It fills one or more lines of the table. To add one: write a
// function that appends it in a file of app/stress and name that in stress_tests().

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "app/stress/random.h"
#include "core/compile/render_scene.h"

namespace lightbench::stress {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// One line of the table. A trial fails by itself or by a measured value above the limit.
struct Line {
  std::string name;
  std::string measure;             ///< what is measured, with its unit; empty: failures only
  double limit_double = kNoLimit;  ///< largest value that passes in the double kernel ...
  double limit_auto = kNoLimit;    ///< ... and in the one that compile() picks
  /// Share of the trials that may fail in the kernel that compile() picks; none in double.
  double allowed_auto = 0;
  /// Above 0: the measure is -log10 of a p-value, and its limit the one that gives all trials of
  /// the line together this significance (Sidak).
  double significance = 0;
};

/// What the trials of a line came to.
class Tally {
 public:
  Tally() = default;
  Tally(double limit, std::uint64_t chunk) : limit_(limit), chunk_(chunk) {}

  void trial(std::uint64_t count = 1) { trials_ += count; }
  /// `describe` says in one line what was asked and answered; called for the first failure only.
  template <class Describe>
  void fail(Describe describe) {
    if (failures_++ == 0) first_failure_ = "chunk " + std::to_string(chunk_) + ": " + describe();
  }
  template <class Describe>
  void measure(double value, Describe describe) {
    if (!(value <= limit_)) fail(describe);
    keep_worst(value);
  }
  /// The tally of later chunks.
  void add(const Tally& other);

  [[nodiscard]] std::uint64_t trials() const { return trials_; }
  [[nodiscard]] std::uint64_t failures() const { return failures_; }
  /// NaN if a measured value was NaN.
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] const std::string& first_failure() const { return first_failure_; }

 private:
  void keep_worst(double value) {
    if (!(value <= worst_) && !std::isnan(worst_)) worst_ = value;
  }

  double limit_ = kNoLimit;
  std::uint64_t chunk_ = 0, trials_ = 0, failures_ = 0;
  double worst_ = 0;
  std::string first_failure_;
};

/// Runs so many trials; `tallies` are the test's lines. Called by several threads at once. An
/// exception fails all of them.
using Chunk = std::function<void(Random& random, std::uint64_t trials, std::span<Tally> tallies)>;

struct Test {
  std::string name;
  std::string distribution;  ///< of the questions
  std::vector<Line> lines;
  std::uint64_t short_trials = 0, long_trials = 0;
  std::uint64_t chunk = 4096;  ///< trials that share a stream of random numbers
  /// Compiles what all chunks need.
  std::function<Chunk(KernelKind)> prepare;
};

/// All tests, in the order of the table.
std::vector<Test> stress_tests();

/// A kernel under test. `strict`: judged by the limits of the double kernel.
struct Subject {
  std::string name;
  KernelKind kernel = KernelKind::Auto;
  bool strict = false;
};

struct SuiteOptions {
  bool long_form = false;
  std::uint64_t seed = 1;
  int threads = 0;          ///< 0: all
  std::string filter;       ///< part of the name of a test or line; empty: all
  std::int64_t chunk = -1;  ///< this chunk alone; -1: all
  std::vector<Subject> subjects;
};

struct LineResult {
  const Test* test = nullptr;
  const Line* line = nullptr;
  const Subject* subject = nullptr;
  double limit = kNoLimit;
  double allowed = 0;  ///< share of failures that passes
  Tally tally;
  double seconds = 0;  ///< of the whole test
  /// Where failures are allowed, a single one passes: too few trials to expect one cannot judge the
  /// share.
  [[nodiscard]] bool passed() const {
    const auto trials = static_cast<double>(tally.trials());
    const double most = allowed > 0 ? std::max(1.0, allowed * trials) : 0;
    return trials > 0 && static_cast<double>(tally.failures()) <= most;
  }
};

/// Runs the tests that the filter leaves and reports each line as it is done.
void run_suite(const std::vector<Test>& tests, const SuiteOptions& options,
               const std::function<void(const LineResult&)>& report);

// The groups, one per file.
void add_sphere_tests(std::vector<Test>& tests);
void add_cylinder_tests(std::vector<Test>& tests);
void add_flat_tests(std::vector<Test>& tests);
void add_polyhedron_tests(std::vector<Test>& tests);
void add_mesh_leak_tests(std::vector<Test>& tests);
void add_solid_leak_tests(std::vector<Test>& tests);
void add_self_hit_tests(std::vector<Test>& tests);
void add_light_angle_tests(std::vector<Test>& tests);
void add_light_tests(std::vector<Test>& tests);
void add_light_variance_tests(std::vector<Test>& tests);
void add_bsdf_tests(std::vector<Test>& tests);
void add_tree_tests(std::vector<Test>& tests);
void add_film_tests(std::vector<Test>& tests);
void add_contact_tests(std::vector<Test>& tests);
void add_room_tests(std::vector<Test>& tests);
void add_media_tests(std::vector<Test>& tests);
void add_glass_picture_tests(std::vector<Test>& tests);
void add_blur_tests(std::vector<Test>& tests);
void add_picture_pair_tests(std::vector<Test>& tests);
void add_determinism_tests(std::vector<Test>& tests);
void add_arithmetic_tests(std::vector<Test>& tests);
void add_glass_tests(std::vector<Test>& tests);
void add_furnace_tests(std::vector<Test>& tests);
void add_chi_square_tests(std::vector<Test>& tests);
void add_path_chi_square_tests(std::vector<Test>& tests);
void add_warp_tests(std::vector<Test>& tests);
void add_sequence_tests(std::vector<Test>& tests);
void add_degenerate_tests(std::vector<Test>& tests);

}  // namespace lightbench::stress
