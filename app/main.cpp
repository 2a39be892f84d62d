// The program: parses the command line, runs one subcommand, turns errors into one line and an exit
// code (docs/command-line.md).

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>

#include "app/commands.h"
#include "app/version.h"
#include "core/error.h"
#include "core/scene/suggest.h"

namespace lightbench {
namespace {

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  return did_you_mean(word, {candidates.begin(), candidates.end()});
}

/// `lightbench`, `lightbench SCENE` and `lightbench --threads 2 SCENE` mean `lightbench view ...`.
void add_default_command(const CLI::App& app, std::vector<std::string>& arguments) {
  if (!arguments.empty()) {
    const std::string& first = arguments.front();
    for (const char* known : {"--help", "-h", "--version", "-V"}) {
      if (first == known) return;
    }
    const std::vector<std::string> names = command_names(app);
    if (std::find(names.begin(), names.end(), first) != names.end()) return;
    const bool is_word = first.find_first_of("-./") == std::string::npos;
    if (is_word && !std::filesystem::exists(first)) {
      throw Error(ErrorKind::Usage,
                  fmt::format("'{}' is neither a subcommand ({}) nor a scene file{}", first,
                              fmt::join(names, ", "), suggestion(first, names)));
    }
  }
  arguments.insert(arguments.begin(), "view");
}

/// The line for arguments that no option took.
std::string describe_extras(const CLI::App& app) {
  const CLI::App& command = app.get_subcommands().empty() ? app : *app.get_subcommands().front();
  const std::vector<std::string> extras = app.remaining(true);
  if (extras.empty()) return "unexpected arguments";
  const std::string flag = extras.front().substr(0, extras.front().find('='));
  if (flag.empty() || flag[0] != '-') {
    return fmt::format("unexpected argument '{}'; see lightbench {} --help", extras.front(),
                       command.get_name());
  }
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return fmt::format("unknown option '{}'{}; see lightbench {} --help", flag,
                     suggestion(flag, names), command.get_name());
}

int run(int argc, char** argv) {
  CLI::App app("Lightbench: an interactive path tracer", "lightbench");
  app.set_version_flag("-V,--version", version_text(), "Print version, compiler and kernels");
  app.require_subcommand(1);
  Action action;
  add_view(app, action);
  add_render(app, action);
  add_screenshot(app, action);
  add_info(app, action);
  add_compare(app, action);
  add_query(app, action);
  add_stress(app, action);
  add_bench(app, action);
  app.footer("Without a subcommand: view. lightbench SUBCOMMAND --help lists its options.");

  std::vector<std::string> arguments(argv + 1, argv + argc);
  add_default_command(app, arguments);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
  try {
    app.parse(arguments);
  } catch (const CLI::Success& request) {
    return app.exit(request);  // --help and --version
  } catch (const CLI::ExtrasError&) {
    throw Error(ErrorKind::Usage, describe_extras(app));
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::Usage, error.what());
  }
  return action();
}

/// Messages are one line whatever a library put into them.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace
}  // namespace lightbench

int main(int argc, char** argv) {
  using lightbench::one_line;
  try {
    return lightbench::run(argc, argv);
  } catch (const lightbench::Error& error) {
    fmt::print(stderr, "lightbench: {}\n", one_line(error.what()));
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "lightbench: out of memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "lightbench: internal error: {}\n", one_line(error.what()));
  }
  return static_cast<int>(lightbench::ErrorKind::Internal);
}
