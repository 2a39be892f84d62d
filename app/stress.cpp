// lightbench stress: the stability suite and its table.

#include "app/stress/suite.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/commands.h"
#include "app/output_names.h"
#include "app/parse.h"
#include "app/version.h"
#include "core/error.h"
#include "core/format.h"
#include "core/scene/file.h"

namespace lightbench {
namespace {

using Json = nlohmann::ordered_json;
using stress::LineResult;

struct StressOptions {
  stress::SuiteOptions suite;
  std::string json, kernel;
  bool list = false;
};

std::vector<stress::Subject> subjects(const std::string& kernel) {
  if (kernel.empty()) {
    return {{"double", best_kernel(Precision::Double), true}, {"auto", KernelKind::Auto, false}};
  }
  const KernelKind kind = parse_kernel("--kernel", kernel);
  const bool strict = kind != KernelKind::Auto && precision_of(kind) == Precision::Double;
  return {{kernel, kind, strict}};
}

std::string limit_text(const LineResult& result) {
  std::string text;
  if (std::isfinite(result.limit)) text = fmt::format("<= {:.3g}", result.limit);
  if (result.allowed > 0)
    text += fmt::format("{}{:.0e} of them", text.empty() ? "" : ", ", result.allowed);
  return text.empty() ? "0" : text;
}

void print_line(const LineResult& result) {
  const stress::Tally& tally = result.tally;
  const std::string worst =
      result.line->measure.empty() ? "" : fmt::format("{:.2e}", tally.worst());
  fmt::print("{:<50} {:<9} {:>10} {:>9} {:>9}  {:<14} {}\n", result.line->name,
             result.subject->name,
             static_cast<double>(tally.trials()) < 1e6
                 ? fmt::format("{}", tally.trials())
                 : fmt::format("{:.3g}", static_cast<double>(tally.trials())),
             tally.failures(), worst, limit_text(result), result.passed() ? "pass" : "FAIL");
  if (!result.passed() && !tally.first_failure().empty()) {
    fmt::print("    {}\n", tally.first_failure());
  }
  std::fflush(stdout);
}

Json to_json(const LineResult& result) {
  const stress::Tally& tally = result.tally;
  const auto finite = [](double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); };
  Json line{{"test", result.test->name},
            {"line", result.line->name},
            {"distribution", result.test->distribution},
            {"kernel", result.subject->name},
            {"trials", tally.trials()},
            {"failures", tally.failures()},
            {"allowedShare", result.allowed},
            {"pass", result.passed()}};
  if (!result.line->measure.empty()) {
    line["measure"] = result.line->measure;
    line["worst"] = finite(tally.worst());
    line["limit"] = finite(result.limit);
  }
  if (!tally.first_failure().empty()) line["firstFailure"] = tally.first_failure();
  line["testSeconds"] = result.seconds;
  return line;
}

void print_list(const std::vector<stress::Test>& tests) {
  for (const stress::Test& test : tests) {
    fmt::print("{}: {}\n", test.name, test.distribution);
    for (const stress::Line& line : test.lines) {
      fmt::print("  {}{}\n", line.name, line.measure.empty() ? "" : ": " + line.measure);
    }
  }
}

int run_stress(StressOptions options) {
  const std::vector<stress::Test> tests = stress::stress_tests();
  if (options.list) {
    print_list(tests);
    return 0;
  }
  options.suite.subjects = subjects(options.kernel);
  if (!options.json.empty()) check_writable(options.json);
  if (options.suite.threads == 0) {
    options.suite.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  }
  fmt::print("{:<50} {:<9} {:>10} {:>9} {:>9}  {:<14} {}\n", "test", "kernel", "trials", "failures",
             "worst", "limit", "verdict");
  Json lines = Json::array();
  int failed = 0;
  const stress::Test* current = nullptr;
  const auto start = std::chrono::steady_clock::now();
  stress::run_suite(tests, options.suite, [&](const LineResult& result) {
    if (result.test != current) {
      current = result.test;
      fmt::print("\n{}: {}\n", current->name, current->distribution);
    }
    print_line(result);
    lines.push_back(to_json(result));
    if (!result.passed()) ++failed;
  });
  if (lines.empty()) {
    throw Error(ErrorKind::Usage, fmt::format("--filter '{}': no test's name contains it; --list "
                                              "prints them",
                                              options.suite.filter));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  fmt::print("\n{} of {} lines pass, seed {}, {}\n",
             lines.size() - static_cast<std::size_t>(failed), lines.size(), options.suite.seed,
             format_duration(seconds.count()));
  if (!options.json.empty()) {
    const Json report{{"version", version_text()},
                      {"seed", options.suite.seed},
                      {"form", options.suite.long_form ? "long" : "short"},
                      {"seconds", seconds.count()},
                      {"failed", failed},
                      {"lines", lines}};
    replace_file(options.json, report.dump(2) + "\n");
  }
  return failed == 0 ? 0 : kExitGateFailed;
}

}  // namespace

void add_stress(CLI::App& app, Action& action) {
  const auto options = std::make_shared<StressOptions>();
  stress::SuiteOptions& suite = options->suite;
  CLI::App& command = *app.add_subcommand(
      "stress", "Run the stability suite: random questions at every scale against exact answers");
  command.add_flag("--long", suite.long_form, "Up to 1e9 trials a test, for an evening");
  command.add_option("--json", options->json, "Write the table there too")->type_name("FILE");
  command.add_option("--filter", suite.filter, "Only tests and lines whose names contain this")
      ->type_name("TEXT");
  command
      .add_option("--kernel", options->kernel,
                  "Test this kernel; default: double, and what is chosen for each scene")
      ->type_name("NAME");
  command.add_option("--seed", suite.seed, "Of the trials' random numbers (1)");
  command.add_option("-t,--threads", suite.threads, "0: all (default)")->check(CLI::Range(0, 1024));
  command.add_option("--chunk", suite.chunk, "Only the chunk that a failure names")
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--list", options->list, "List the tests, run none");
  command.callback([options, &action] { action = [options] { return run_stress(*options); }; });
}

}  // namespace lightbench
