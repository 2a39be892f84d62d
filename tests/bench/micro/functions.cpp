// The kernel's small functions by target: hit tests per shape, dimensions of the sampler, BSDFs,
// adding to the film. An item is one lane's work.

#include <benchmark/benchmark.h>

#include "core/compile/render_scene.h"
#include "tests/bench/micro/subjects.h"

namespace lightbench::micro {
namespace {

constexpr std::size_t kCount = std::size_t{1} << 14;

const KernelParts<float>& parts_of(const RenderScene& scene) {
  return std::get<KernelParts<float>>(scene.parts->kernel);
}

/// A scene of one shape and one material.
std::shared_ptr<const RenderScene> compile_one(const Shape& shape, const Material& material) {
  Scene scene;
  scene.environment.color = glm::dvec3(1);
  scene.materials.push_back(material);
  Object object;
  object.shape = shape;
  object.material = 0;
  scene.objects.push_back(object);
  return compile(scene, KernelKind::Scalar);
}

void add_line(const std::string& name, auto work) {
  benchmark::RegisterBenchmark(name.c_str(), [work](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(work());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
  });
}

void add_target(const std::string& target, const KernelLoops<float>& loops) {
  const std::pair<const char*, Shape> shapes[] = {
      {"sphere", SphereShape{}},
      {"cylinder", CylinderShape{{0, -1, 0}, {0, 1, 0}, 0.7}},
      {"disc", DiscShape{glm::dvec3(0), {0.1, 0.2, 1}, 1}},
      {"rectangle", RectangleShape{{-1, -1, 0}, {2, 0, 0.3}, {0, 2, 0.2}}},
      {"triangle", TriangleShape{{-1, -1, 0}, {1, -1, 0.1}, {0, 1, 0.2}}},
      {"pyramid", PyramidShape{{glm::dvec3(0, 1, 0), {-1, -1, -1}, {1, -1, -1}, {0, -1, 1}}}},
      {"box", BoxShape{glm::dvec3(-1), glm::dvec3(1)}},
  };
  static const RaySet rays = chords_of_ball(2, kCount);
  for (const auto& [name, shape] : shapes) {
    const auto scene = compile_one(shape, Material{});
    add_line(std::string("hit/") + name + "/" + target,
             [scene, &loops] { return loops.shape(parts_of(*scene).view, rays); });
  }
  add_line("sampler/pair/" + target, [&loops] { return loops.sampler(kCount); });
  Material lambertian, mirror, fuzz, ggx, glass;
  mirror.kind = fuzz.kind = ggx.kind = MaterialKind::Metal;
  fuzz.fuzz = 0.3;
  ggx.roughness = 0.3;
  glass.kind = MaterialKind::Dielectric;
  const std::pair<const char*, Material> materials[] = {{"lambertian", lambertian},
                                                        {"mirror", mirror},
                                                        {"fuzz", fuzz},
                                                        {"ggx", ggx},
                                                        {"glass", glass}};
  for (const auto& [name, material] : materials) {
    const auto scene = compile_one(SphereShape{}, material);
    add_line(std::string("sample/") + name + "/" + target,
             [scene, &loops] { return loops.sample_bsdf(parts_of(*scene).view, kCount); });
    if (material.kind == MaterialKind::Dielectric || name == std::string("mirror")) continue;
    add_line(std::string("eval/") + name + "/" + target,
             [scene, &loops] { return loops.eval_bsdf(parts_of(*scene).view, kCount); });
  }
  const auto scene = compile_one(SphereShape{}, Material{});
  const auto film = std::make_shared<Film>(128, 128, scene->film_unit);
  static_assert(kCount == 128 * 128);
  add_line("film/add/" + target, [scene, film, &loops] {
    loops.film(parts_of(*scene).view, film->view(), kCount);
    return film->pixels().front().r;
  });
}

}  // namespace

void add_functions() {
#ifdef LIGHTBENCH_X86
  if (kernel_supported(KernelKind::Avx512)) add_target("avx512", avx512::loops);
  if (kernel_supported(KernelKind::Avx2)) add_target("avx2", avx2::loops);
#endif
  add_target("scalar", scalar::loops);
}

}  // namespace lightbench::micro
