#include "app/bench/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <memory>
#include <vector>

#include "app/image_difference.h"
#include "app/on_threads.h"
#include "app/version.h"
#include "core/compile/render_scene.h"
#include "core/error.h"
#include "core/film/image_file.h"
#include "core/scene/picture_hash.h"

namespace lightbench::bench {
namespace {

constexpr std::uint32_t kPartSpp = 256;
constexpr int kLeastParts = 8;

/// Sums of independent pictures and of their squares, per value.
struct Parts {
  std::vector<double> sum, squares;
  int count = 0;

  void add(const Image& image) {
    sum.resize(image.rgb.size());
    squares.resize(image.rgb.size());
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      const double v = image.rgb[i];
      sum[i] += v;
      squares[i] += v * v;
    }
    ++count;
  }
  /// Means into `reference`, and their expected squared errors.
  void summarize(Reference& reference) const {
    reference.mse = reference.relmse = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      const double mean = sum[i] / count;
      const double spread = std::max(0.0, squares[i] - mean * sum[i]) / (count - 1) / count;
      reference.image.rgb[i] = static_cast<float>(mean);
      reference.mse += spread;
      reference.relmse += spread / (mean * mean + kRelativeFloor);
    }
    reference.mse /= static_cast<double>(sum.size());
    reference.relmse /= static_cast<double>(sum.size());
  }
};

/// Throws if a sample was dropped: the mean would be of the others.
Image render_part(const RenderScene& scene, int threads) {
  const Crop& window = scene.crop;
  Film film(window.width, window.height, scene.film_unit);
  const auto rows = static_cast<std::uint64_t>(window.height);
  std::atomic<std::uint64_t> dropped{0};
  for_each_on_threads(0, rows, threads, [&](std::uint64_t row) {
    const int y = static_cast<int>(row);
    Counters counters;
    render(scene, Work{0, y, window.width, y + 1, 0, kPartSpp, 1}, film.view(), counters);
    dropped += counters.non_finite;
  });
  if (dropped > 0) {
    throw Error(ErrorKind::Scene, fmt::format("{} samples of the reference are not finite and were "
                                              "dropped: it would be biased; lightbench render says "
                                              "which",
                                              dropped.load()));
  }
  return film.mean(kPartSpp);
}

template <class Number>
Number read_number(const ImageMetadata& header, const std::string& key, int base = 10) {
  const auto at = header.find(key);
  Number value{};
  if (at == header.end()) return value;
  const char* begin = at->second.data();
  const char* end = begin + at->second.size();
  if constexpr (std::is_floating_point_v<Number>) {
    std::from_chars(begin, end, value);
  } else {
    std::from_chars(begin, end, value, base);
  }
  return value;
}

}  // namespace

std::filesystem::path reference_file(const std::filesystem::path& folder,
                                     const std::filesystem::path& scene_file) {
  return folder / scene_file.stem().concat(".exr");
}

Reference load_reference(const std::filesystem::path& file, const Scene& scene,
                         const std::filesystem::path& scene_file) {
  const auto remedy = [&] {
    return fmt::format("make it with: lightbench bench {} --make-references", scene_file.string());
  };
  if (!std::filesystem::exists(file)) {
    throw Error(ErrorKind::Scene, fmt::format("{}: no reference for {}; {}", file.string(),
                                              scene_file.string(), remedy()));
  }
  Reference reference;
  reference.image = read_image(file);
  const ImageMetadata header = read_image_metadata(file);
  reference.hash = read_number<std::uint64_t>(header, "pictureHash", 16);
  reference.spp = read_number<std::uint32_t>(header, "samplesPerPixel");
  reference.mse = read_number<double>(header, "MSE");
  reference.relmse = read_number<double>(header, "relMSE");
  const std::uint64_t expected = picture_hash(scene);
  if (reference.hash != expected) {
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: reference of another picture (hash {:016x}, {} has {:016x}: the "
                    "scene, its files or the resolution changed); {}",
                    file.string(), reference.hash, scene_file.string(), expected, remedy()));
  }
  return reference;
}

Reference make_reference(const Scene& scene, const ReferenceGoal& goal,
                         const ReferenceProgress& progress) {
  const auto start = std::chrono::steady_clock::now();
  std::shared_ptr<const RenderScene> compiled = compile(scene, best_kernel(Precision::Double));
  Reference reference;
  reference.hash = picture_hash(scene);
  reference.image = {compiled->crop.width, compiled->crop.height, {}};
  reference.image.rgb.resize(3 * reference.image.pixel_count());
  Parts parts;
  Scene part = scene;
  for (;;) {
    // Seeds that no benchmark uses: those count from 0.
    part.render.seed = ~static_cast<std::uint32_t>(parts.count);
    compiled = compile(part, compiled->kernel, compiled.get(), Change::Settings);
    parts.add(render_part(*compiled, goal.threads));
    reference.spp += kPartSpp;
    if (parts.count < 2) continue;
    parts.summarize(reference);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const double share = std::max(seconds.count() / goal.seconds,
                                  std::min(1.0, goal.relmse / std::max(reference.relmse, 1e-300)));
    progress(std::min(share, static_cast<double>(parts.count) / kLeastParts), reference.relmse,
             seconds.count());
    if (parts.count >= kLeastParts && share >= 1) return reference;
  }
}

void save_reference(const std::filesystem::path& file, const Reference& reference,
                    const std::filesystem::path& scene_file) {
  const ImageMetadata header = {
      {"Software", "lightbench " + version_number()},
      {"Scene", scene_file.filename().string()},
      {"recipe", "mean of independent renders of 256 spp, double precision kernel"},
      {"pictureHash", fmt::format("{:016x}", reference.hash)},
      {"samplesPerPixel", std::to_string(reference.spp)},
      {"MSE", fmt::format("{:.6g}", reference.mse)},
      {"relMSE", fmt::format("{:.6g}", reference.relmse)},
  };
  write_image(file, reference.image, {}, header, {}, ExrNumbers::Float);
}

}  // namespace lightbench::bench
