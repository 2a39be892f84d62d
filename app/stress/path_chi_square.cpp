// What only whole paths show: the phase function and free flights of a medium, the lens, the pixel
// filters and the shutter. Samples of the picture, each from a pixel of its own, against what they
// should be distributed as.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/proof/chi_square.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"
#include "core/query/path.h"

namespace lightbench::stress {
using namespace proof;
namespace {

constexpr int kSide = 512;
constexpr std::size_t kSamples = 1 << 15;
constexpr double kRadius = 1.5;  ///< of the filters
constexpr double kLens = 0.25, kFocus = 4;

enum class Part { Phase, Flight, Lens, Box, Triangle, Gaussian, Shutter, Camera };
constexpr const char* kNames[] = {"phase function", "free flight",     "lens",    "box filter",
                                  "tent filter",    "Gaussian filter", "shutter", "whole camera"};
constexpr std::size_t kParts = std::size(kNames);

Scene scene_of(Part part) {
  Scene scene = empty_scene();
  scene.render.width = scene.render.height = kSide;
  scene.camera.vfov = 90;
  scene.render.filter_radius = part == Part::Camera ? 0.5 : kRadius;
  if (part == Part::Triangle) scene.render.filter = FilterKind::Triangle;
  if (part == Part::Gaussian) scene.render.filter = FilterKind::Gaussian;
  if (part == Part::Phase || part == Part::Flight) {
    scene.media.emplace_back();
    scene.media.back().name = "fog";
    Object& o = add_object(scene, SphereShape{glm::dvec3(0), 1000, glm::dvec3(0)});
    o.material = kNone;
    o.medium = 0;
  }
  if (part == Part::Lens || part == Part::Camera) {
    scene.camera.lens_radius = kLens;
    scene.camera.focus_distance = kFocus;
  }
  if (part == Part::Shutter || part == Part::Camera) {
    add_object(scene, SphereShape{{0, 0, 50}, 1, {1, 0, 0}});  // behind the camera
  }
  return scene;
}

/// Position in the pixel in units of the filter's radius, from the first segment.
glm::dvec2 filter_position(const PathVertex& v, const SampleName& name, double radius) {
  // Through the focal plane, where a lens is sharp.
  const double t = (kFocus + v.origin.z) / -v.direction.z;
  const double x = (v.origin.x + t * v.direction.x) / kFocus;
  const double y = (v.origin.y + t * v.direction.y) / kFocus;
  return glm::dvec2((x + 1) * (0.5 * kSide) - name.x - 0.5,
                    (1 - y) * (0.5 * kSide) - name.y - 0.5) /
         radius;
}

/// Coordinates that the sample should fill evenly: all in [0,1).
std::vector<double> coordinates(Part part, const PathVertex& v, const SampleName& name) {
  const auto tent = [](double x) {
    return x < 0 ? 0.5 * (1 + x) * (1 + x) : 1 - 0.5 * (1 - x) * (1 - x);
  };
  const glm::dvec2 f = filter_position(v, name, kRadius);
  const double lens = (v.origin.x * v.origin.x + v.origin.y * v.origin.y) / (kLens * kLens);
  switch (part) {
    case Part::Phase: {
      const glm::dvec3 d = v.scattered ? v.scattered->wi : glm::dvec3(2);
      return {0.5 * (1 + d.z), turn(d.y, d.x)};
    }
    case Part::Flight:
      return {-std::expm1(-v.distance)};
    case Part::Lens:
      return {lens, turn(v.origin.y, v.origin.x)};
    case Part::Box:
      return {0.5 * (1 + f.x), 0.5 * (1 + f.y)};
    case Part::Triangle:
      return {tent(f.x), tent(f.y)};
    case Part::Gaussian:
      return {std::expm1(-2 * (f.x * f.x + f.y * f.y)) / std::expm1(-2), turn(f.y, f.x)};
    case Part::Shutter:
      return {v.time};
    case Part::Camera:
      break;
  }
  const glm::dvec2 p = filter_position(v, name, 0.5);
  return {lens, turn(v.origin.y, v.origin.x), 0.5 * (1 + p.x), 0.5 * (1 + p.y), v.time};
}

int cells_per_axis(Part part) { return part == Part::Camera ? 4 : 16; }

void judge(Random& random, Part part, const RenderScene& scene, std::span<Tally> tallies) {
  const int cells = cells_per_axis(part);
  const auto first = static_cast<std::uint32_t>(random.below(1 << 20));
  std::vector<double> observed;
  double outside = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const int pixel = static_cast<int>(i) * (kSide * kSide / static_cast<int>(kSamples));
    const SampleName name{pixel % kSide, pixel / kSide, first};
    const std::vector<double> at =
        coordinates(part, trace_path(scene, name).vertices.front(), name);
    std::size_t cell = 0, count = 1;
    for (const double x : at) {
      // A rounding beyond the border is none of the distribution's.
      outside = std::max(outside, std::max(-x, x - 1));
      cell = cell * static_cast<std::size_t>(cells) +
             static_cast<std::size_t>(std::clamp(x * cells, 0.0, cells - 1.0));
      count *= static_cast<std::size_t>(cells);
    }
    observed.resize(count);
    observed[cell] += 1;
  }
  const std::vector<double> expected(
      observed.size(), static_cast<double>(kSamples) / static_cast<double>(observed.size()));
  const proof::ChiSquare r = proof::chi_square(observed, expected);
  const auto text = [&] {
    return fmt::format(
        "{}, sample {} of every eighth pixel: chi-square {:.6g} of {}, {:.3g} "
        "outside",
        kNames[static_cast<std::size_t>(part)], first, r.statistic, r.freedom, outside);
  };
  for (Tally& tally : tallies) tally.trial();
  tallies[0].measure(-std::log10(r.p_value), text);
  tallies[1].measure(outside, text);
}

}  // namespace

void add_path_chi_square_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"camera and media densities",
       "phase function, free flight, lens, box, tent and Gaussian filter, shutter, and all five "
       "dimensions of the camera at once; 32768 samples, each from a pixel of its own",
       {{"camera and media, chi-square of samples", "-log10 p", 0, 0, 0, 0.01},
        {"camera and media, samples outside", "distance beyond the border / width", 1e-9, 1e-3}},
       8,
       1'000,
       8,
       [](KernelKind kernel) -> Chunk {
         std::vector<std::shared_ptr<const RenderScene>> scenes;
         for (std::size_t k = 0; k < kParts; ++k) {
           scenes.push_back(compile(scene_of(static_cast<Part>(k)), kernel));
         }
         return [scenes](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const std::size_t k = i % kParts;
             judge(random, static_cast<Part>(k), *scenes[k], tallies);
           }
         };
       }});
}

}  // namespace lightbench::stress
