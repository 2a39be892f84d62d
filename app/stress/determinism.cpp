// The same bytes however the work is done: threads, tiles, pauses, ranges of samples that are added
// up, and kernels of one precision.

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "app/proof/measure.h"
#include "app/stress/random_room.h"
#include "app/stress/suite.h"
#include "core/session/session.h"

namespace lightbench::stress {
using namespace proof;
namespace {

constexpr int kSize = 40, kSpp = 6;

/// Random tiles in random order, and the samples in random ranges.
Film render_in_pieces(Random& random, const RenderScene& scene) {
  const int edge = 1 + random.below(kSize);
  std::vector<Work> pieces;
  for (int first = 0, last = 0; first < kSpp; first = last) {
    last = std::min(kSpp, first + 1 + random.below(kSpp));
    for (int y = 0; y < kSize; y += edge) {
      for (int x = 0; x < kSize; x += edge) {
        pieces.push_back({x, y, std::min(x + edge, kSize), std::min(y + edge, kSize),
                          static_cast<std::uint32_t>(first),
                          static_cast<std::uint32_t>(last - first), 1});
      }
    }
  }
  for (std::size_t i = pieces.size(); i > 1; --i) {
    std::swap(pieces[i - 1], pieces[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  }
  Film film(kSize, kSize, scene.film_unit);
  Counters counters;
  for (const Work& piece : pieces) render(scene, piece, film.view(), counters);
  return film;
}

/// Films of two ranges of samples, added up as two machines might.
Film render_and_merge(const RenderScene& scene, int split) {
  Film film = render_film(scene, split);
  const Film rest = render_film(scene, kSpp - split, split);
  FilmPixel* const pixels = film.view().pixels;
  for (std::size_t i = 0; i < rest.pixels().size(); ++i) {
    const FilmPixel& p = rest.pixels()[i];
    pixels[i].r += p.r;
    pixels[i].g += p.g;
    pixels[i].b += p.b;
    pixels[i].luminance_squared += p.luminance_squared;
  }
  return film;
}

/// Through a session that is paused on the way.
std::vector<float> render_with_pauses(Scene scene, KernelKind kernel) {
  scene.render.spp = kSpp;
  scene.render.time_limit = 0;
  scene.render.snapshots = {};
  Session session({3, false, false, kernel});
  session.submit(std::move(scene));
  for (bool paused = true;; paused = !paused) {
    session.pause(paused);
    const SessionStatus status = session.status();
    if (status.state == SessionState::Finished) return session.latest()->image.rgb;
    if (status.state == SessionState::Failed) return {};
    if (!paused) session.wait(0, 0.001);
  }
}

std::vector<KernelKind> others_of(Precision precision) {
  std::vector<KernelKind> kernels;
  for (const KernelKind kind : kKernels) {
    if (precision_of(kind) == precision && kernel_supported(kind)) kernels.push_back(kind);
  }
  return kernels;
}

void compare_all(Random& random, KernelKind kernel, Tally& tally) {
  const Scene room = random_room(random, kSize);
  const auto scene = compile(room, kernel);
  const Film plain = render_film(*scene, kSpp);
  const auto check = [&](const std::string& what, bool same) {
    tally.trial();
    if (!same) tally.fail([&] { return describe_room(room) + ": " + what; });
  };
  for (const int threads : {1, 2, 7, 64}) {
    check(fmt::format("{} threads", threads),
          render_on_threads(*scene, kSpp, threads).hash() == plain.hash());
  }
  check("tiles and ranges in any order", render_in_pieces(random, *scene).hash() == plain.hash());
  check("two ranges added up",
        render_and_merge(*scene, 1 + random.below(kSpp - 1)).hash() == plain.hash());
  check("paused", render_with_pauses(room, kernel) == plain.mean(kSpp).rgb);
  for (const KernelKind kind : others_of(precision_of(scene->kernel))) {
    check(kernel_name(kind), render_film(room, kind, kSpp).hash() == plain.hash());
  }
}

}  // namespace

void add_determinism_tests(std::vector<Test>& tests) {
  tests.push_back({"determinism",
                   "rooms of random shapes and materials; 1, 2, 7, 64 threads, tiles and ranges of "
                   "samples in any order, two ranges added up, pauses, every kernel of the "
                   "precision",
                   {{"determinism, different bytes", "", kNoLimit, kNoLimit, 0}},
                   6,
                   5000,
                   1,
                   [](KernelKind kernel) -> Chunk {
                     return
                         [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
                           for (std::uint64_t i = 0; i < trials; ++i) {
                             compare_all(random, kernel, tallies[0]);
                           }
                         };
                   }});
}

}  // namespace lightbench::stress
