#pragma once
// compile(): an editable Scene becomes an immutable RenderScene in render space, shared by threads.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/film/counters.h"
#include "core/film/film.h"
#include "core/scene/change.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Which build of the kernel traces. Auto: the precision that the scene's range asks for
/// (scene_reach.h), as wide as this processor runs. Kernels of one precision give the same bits;
/// Scalar is the plain float one, Reference the plain double one.
enum class KernelKind { Auto, Avx512, Avx2, Scalar, Avx512Double, Avx2Double, Reference };
inline constexpr KernelKind kKernels[] = {KernelKind::Avx512,     KernelKind::Avx2,
                                          KernelKind::Scalar,     KernelKind::Avx512Double,
                                          KernelKind::Avx2Double, KernelKind::Reference};
const char* kernel_name(KernelKind kind);
enum class Precision { Float, Double };
Precision precision_of(KernelKind kind);
/// The widest kernel of a precision that this processor runs.
KernelKind best_kernel(Precision precision);
/// False for kernels whose instruction set this processor lacks. Auto is always supported.
bool kernel_supported(KernelKind kind);

/// Consecutive sample indices of one pixel.
struct SampleRange {
  std::uint32_t first = 0, count = 0;
};

/// A rectangle of film pixels and a range of sample indices, or one for each pixel in `ranges`, row
/// by row. `stride` d > 1 renders the quick look: film pixel (x, y) covers d x d pixels of the
/// picture.
struct Work {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::uint32_t first_sample = 0;
  std::uint32_t sample_count = 1;
  int stride = 1;
  const SampleRange* ranges = nullptr;  ///< then the two above mean nothing
};

/// One line of `lightbench info`: a feature the kernel has and whether this scene uses it.
struct FeatureUse {
  std::string name;
  bool used = false;
  std::string note;
};

struct RenderStats {
  std::int64_t objects = 0;
  std::int64_t primitives = 0;             ///< analytic shapes plus instanced triangles
  std::int64_t triangles = 0;              ///< unique mesh triangles
  std::int64_t lights = 0;                 ///< emitters the light sampler can choose
  std::int64_t bytes = 0;                  ///< memory of the compiled scene
  KernelKind kernel = KernelKind::Scalar;  ///< never Auto
  double range = 1;                        ///< farthest over smallest feature, scene_reach.h
  std::string smallest_object;             ///< the object with the smallest feature
  Precision precision = Precision::Float;  ///< what Auto chooses ...
  std::string precision_reason;            ///< ... and why, in a sentence
  double compile_seconds = 0;
  Change rebuilt = Change::None;  ///< what this compile rebuilt; the rest is shared with `previous`
  std::vector<FeatureUse> features;
};

/// Immutable; many threads may trace it at once. Opaque but for what a session or a UI needs.
struct RenderScene {
  int width = 0, height = 0;  ///< of the whole picture
  Crop crop;                  ///< window that the film holds; full picture if none asked
  double film_unit = 1;       ///< radiance, see film.h
  KernelKind kernel = KernelKind::Scalar;  ///< never Auto
  RenderStats stats;
  struct Parts;  ///< arrays in render space (core/compile/parts.h)
  std::shared_ptr<const Parts> parts;
};

/// `previous` (may be null) is the result for the scene before `change`; everything that the change
/// does not touch is shared with it. `scene` must have passed validate().
std::shared_ptr<const RenderScene> compile(const Scene& scene, KernelKind kernel,
                                           const RenderScene* previous = nullptr,
                                           Change change = Change::All);

/// Adds the samples of `work` to `film` (the film of the crop window, divided by work.stride).
/// A sample is a pure function of (scene, pixel, sample index).
void render(const RenderScene& scene, const Work& work, FilmView film, Counters& counters);

}  // namespace lightbench
