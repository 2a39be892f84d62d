// lightbench compare: how far one image is from another, for people and for test gates.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
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

/// Over all pixels and the three channels, of linear values.
struct Difference {
  double mse = 0;
  double relmse = 0;  ///< mean((a - b)^2 / (b^2 + 0.01))
  double max = 0;     ///< largest |a - b|
  int max_x = 0, max_y = 0;
  std::array<double, 3> mean{};  ///< of a - b per channel: bias, where noise cancels
  std::size_t non_finite = 0;    ///< values that are NaN or infinite in either image
};

Difference difference(const Image& a, const Image& b) {
  Difference result;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const double x = a.rgb[i], y = b.rgb[i];
    if (!std::isfinite(x) || !std::isfinite(y)) {
      ++result.non_finite;
      continue;
    }
    const double d = x - y;
    result.mse += d * d;
    result.relmse += d * d / (y * y + 0.01);
    result.mean[i % 3] += d;
    if (std::abs(d) > result.max) {
      result.max = std::abs(d);
      const auto pixel = static_cast<int>(i / 3);
      result.max_x = pixel % a.width;
      result.max_y = pixel / a.width;
    }
  }
  const auto values = static_cast<double>(std::max<std::size_t>(1, a.rgb.size()));
  result.mse /= values;
  result.relmse /= values;
  for (double& mean : result.mean) mean *= 3 / values;
  return result;
}

int compare(const CompareOptions& options) {
  const Image a = read_image(options.image);
  const Image b = read_image(options.reference);
  if (a.width != b.width || a.height != b.height) {
    throw Error(
        ErrorKind::Scene,
        fmt::format("{} is {}x{} but {} is {}x{}: expected images of equal size", options.image,
                    a.width, a.height, options.reference, b.width, b.height));
  }
  const Difference d = difference(a, b);
  const double bias = (d.mean[0] + d.mean[1] + d.mean[2]) / 3;
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
