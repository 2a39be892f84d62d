// lightbench compare: how far one image is from another, for people and for test gates.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/image_difference.h"
#include "core/error.h"
#include "core/film/image_file.h"

namespace lightbench {
namespace {

struct CompareOptions {
  std::string image;
  std::string reference;
  double max_relmse = -1;  // < 0: no gate
  bool json = false;
};

int compare(const CompareOptions& options) {
  const Image a = read_image(options.image);
  const Image b = read_image(options.reference);
  if (a.width != b.width || a.height != b.height) {
    throw Error(
        ErrorKind::Scene,
        fmt::format("{} is {}x{} but {} is {}x{}: expected images of equal size", options.image,
                    a.width, a.height, options.reference, b.width, b.height));
  }
  const ImageDifference d = difference(a, b);
  const double bias = d.bias();
  const bool gated = options.max_relmse >= 0;
  const bool passed = d.non_finite == 0 && (!gated || d.relmse <= options.max_relmse);
  if (options.json) {
    nlohmann::ordered_json json = {
        {"mse", d.mse},
        {"relMSE", d.relmse},
        {"max", d.max},
        {"maxPixel", {d.max_x, d.max_y}},
        {"meanSignedDifference", bias},
        {"meanSignedDifferenceRgb", d.mean},
        {"nonFinite", d.non_finite},
    };
    if (gated) json["passed"] = passed;
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("MSE     {:.6g}\nrelMSE  {:.6g}\nmax     {:.6g} at pixel {},{}\n", d.mse, d.relmse,
               d.max, d.max_x, d.max_y);
    fmt::print("mean    {:+.6g} (red {:+.6g}, green {:+.6g}, blue {:+.6g})\n", bias, d.mean[0],
               d.mean[1], d.mean[2]);
    if (d.non_finite > 0) fmt::print("{} values are not finite\n", d.non_finite);
    if (gated) {
      fmt::print("{}: relMSE may be up to {:g}\n", passed ? "passed" : "failed",
                 options.max_relmse);
    }
  }
  return gated && !passed ? kExitGateFailed : 0;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App& command =
      *app.add_subcommand("compare", "Measure how far an image is from a reference");
  command.add_option("IMAGE", options->image, "Image to judge")->type_name("FILE")->required();
  command.add_option("REFERENCE", options->reference, "Image to judge it by")
      ->type_name("FILE")
      ->required();
  command
      .add_option("--max-relmse", options->max_relmse,
                  "Exit with 6 if relMSE = mean((a-b)^2 / (b^2 + 0.01)) is larger")
      ->type_name("X")
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--json", options->json, "Print JSON");
  command.callback([options, &action] { action = [options] { return compare(*options); }; });
}

}  // namespace lightbench
