#pragma once
// The subcommands of the command line. Each add_ function declares its own options on `app` and, if
// the user chose it, leaves what to do in `action`; main runs that and turns Error into an exit
// code.

#include <functional>

namespace CLI {
class App;
}

namespace lightbench {

/// What 0..4 of ErrorKind leave: exit codes of runs that produced a picture or a verdict.
inline constexpr int kExitStoppedByLimit = 5;  ///< the image is saved, the target is not reached
inline constexpr int kExitGateFailed = 6;      ///< compare --max-relmse, a line of stress

/// Returns the exit code; may throw Error.
using Action = std::function<int()>;

void add_view(CLI::App& app, Action& action);
void add_render(CLI::App& app, Action& action);
void add_screenshot(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_query(CLI::App& app, Action& action);
void add_stress(CLI::App& app, Action& action);
void add_bench(CLI::App& app, Action& action);

}  // namespace lightbench
