// view and screenshot in a program built without its interface: they say so.

#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "core/error.h"

namespace lightbench {
namespace {

void add_missing(CLI::App& app, Action& action, const char* name, const char* description) {
  CLI::App& command = *app.add_subcommand(name, description);
  command.allow_extras();  // whatever they are, the answer is the same
  command.callback([&action, name] {
    action = [name]() -> int {
      throw Error(ErrorKind::Usage, std::string(name) +
                                        ": this lightbench was built without its interface " +
                                        "(LIGHTBENCH_UI); expected render, info or compare");
    };
  });
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  add_missing(app, action, "view", "Edit a scene in a window (not in this build)");
}

void add_screenshot(CLI::App& app, Action& action) {
  add_missing(app, action, "screenshot", "Draw the interface to an image (not in this build)");
}

}  // namespace lightbench
