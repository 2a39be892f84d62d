#include "app/stress/suite.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "app/on_threads.h"
#include "app/proof/chi_square.h"

namespace lightbench::stress {
using namespace proof;
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool wanted(const Test& test, const std::string& filter) {
  return contains(test.name, filter) ||
         std::any_of(test.lines.begin(), test.lines.end(),
                     [&](const Line& line) { return contains(line.name, filter); });
}

double limit_of(const Line& line, const Subject& subject, std::uint64_t trials) {
  if (line.significance > 0) {
    return -std::log10(proof::sidak(line.significance, std::max<std::uint64_t>(trials, 1)));
  }
  return subject.strict ? line.limit_double : line.limit_auto;
}

std::uint64_t trials_of(const Test& test, const SuiteOptions& options) {
  return options.long_form ? test.long_trials : test.short_trials;
}

std::vector<Tally> run_test(const Test& test, const SuiteOptions& options, const Subject& subject) {
  const std::uint64_t trials = trials_of(test, options);
  const std::uint64_t chunks = (trials + test.chunk - 1) / test.chunk;
  std::uint64_t begin = 0, end = chunks;
  if (options.chunk >= 0) {
    begin = static_cast<std::uint64_t>(options.chunk);
    end = begin + 1;
  }
  const auto empty = [&](std::uint64_t chunk) {
    std::vector<Tally> tallies;
    for (const Line& line : test.lines)
      tallies.emplace_back(limit_of(line, subject, trials), chunk);
    return tallies;
  };
  const Chunk run = test.prepare(subject.kernel);
  // Long runs have many chunks: they are added up in order, in groups.
  constexpr std::uint64_t kGroup = 1024;
  std::vector<Tally> total = empty(begin);
  for (std::uint64_t first = begin; first < end; first += kGroup) {
    const std::uint64_t last = std::min(end, first + kGroup);
    std::vector<std::vector<Tally>> parts(last - first);
    for_each_on_threads(first, last, options.threads, [&](std::uint64_t chunk) {
      Random random(options.seed, test.name, chunk);
      std::vector<Tally> tallies = empty(chunk);
      try {
        run(random, std::min(test.chunk, trials - std::min(trials, chunk * test.chunk)), tallies);
      } catch (const std::exception& error) {
        for (Tally& tally : tallies) {
          tally.trial();
          tally.fail([&] { return std::string(error.what()); });
        }
      }
      parts[chunk - first] = std::move(tallies);
    });
    for (const std::vector<Tally>& part : parts) {
      for (std::size_t k = 0; k < total.size(); ++k) total[k].add(part[k]);
    }
  }
  return total;
}

}  // namespace

void Tally::add(const Tally& other) {
  if (failures_ == 0) first_failure_ = other.first_failure_;
  trials_ += other.trials_;
  failures_ += other.failures_;
  keep_worst(other.worst_);
}

std::vector<Test> stress_tests() {
  std::vector<Test> tests;
  add_arithmetic_tests(tests);
  add_sphere_tests(tests);
  add_cylinder_tests(tests);
  add_flat_tests(tests);
  add_polyhedron_tests(tests);
  add_mesh_leak_tests(tests);
  add_solid_leak_tests(tests);
  add_self_hit_tests(tests);
  add_light_angle_tests(tests);
  add_light_tests(tests);
  add_light_variance_tests(tests);
  add_bsdf_tests(tests);
  add_furnace_tests(tests);
  add_glass_tests(tests);
  add_chi_square_tests(tests);
  add_path_chi_square_tests(tests);
  add_warp_tests(tests);
  add_sequence_tests(tests);
  add_tree_tests(tests);
  add_film_tests(tests);
  add_contact_tests(tests);
  add_room_tests(tests);
  add_media_tests(tests);
  add_glass_picture_tests(tests);
  add_blur_tests(tests);
  add_picture_pair_tests(tests);
  add_determinism_tests(tests);
  add_degenerate_tests(tests);
  return tests;
}

void run_suite(const std::vector<Test>& tests, const SuiteOptions& options,
               const std::function<void(const LineResult&)>& report) {
  for (const Test& test : tests) {
    if (!wanted(test, options.filter)) continue;
    for (const Subject& subject : options.subjects) {
      const auto start = std::chrono::steady_clock::now();
      const std::vector<Tally> tallies = run_test(test, options, subject);
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      for (std::size_t k = 0; k < test.lines.size(); ++k) {
        const Line& line = test.lines[k];
        if (!contains(test.name, options.filter) && !contains(line.name, options.filter)) continue;
        const double allowed = subject.strict ? 0 : line.allowed_auto;
        const double limit = limit_of(line, subject, trials_of(test, options));
        report({&test, &line, &subject, limit, allowed, tallies[k], seconds.count()});
      }
    }
  }
}

}  // namespace lightbench::stress
