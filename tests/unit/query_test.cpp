// Questions put to compiled scenes: many at once are as many alone, and nothing is lost at the
// border between the scene's units and the kernel's.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <random>

#include "core/query/convert.h"
#include "core/query/lights.h"
#include "core/query/materials.h"
#include "core/query/rays.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

using glm::dvec3;

class Random {
 public:
  double unit() { return uniform_(engine_); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  dvec3 direction() {
    const double z = between(-1, 1), a = between(0, 6.283185307179586);
    return {std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z};
  }

 private:
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_;
};

std::vector<KernelKind> kernels() {
  std::vector<KernelKind> found;
  for (const KernelKind kind :
       {KernelKind::Scalar, KernelKind::Avx2, KernelKind::Avx512, KernelKind::Reference}) {
    if (kernel_supported(kind)) found.push_back(kind);
  }
  return found;
}

Scene stored_scene(const char* name) {
  return load_scene(std::filesystem::path(LIGHTBENCH_SOURCE_DIR) / "scenes" / name);
}

const char* const kScenes[] = {"cornell-three-lights.json", "cornell-smoke.json",
                               "features/shape-lights.json", "features/shape-mesh.json",
                               "features/motion-blur.json"};

/// Rays through the picture and a bit beyond, 1.7 long.
std::vector<Ray> picture_rays(const Scene& scene, int count) {
  Random random;
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    rays.push_back(camera_ray(scene, random.between(-0.2, 1.2) * scene.render.width,
                              random.between(-0.2, 1.2) * scene.render.height));
    rays.back().direction *= 1.7;
    rays.back().time = random.between(scene.camera.shutter_open, scene.camera.shutter_close);
  }
  return rays;
}

/// Alone: of radius 1 around 0, before it is transformed.
Scene disc_lamp(const dvec3& normal, const Transform& transform = {}) {
  Scene scene;
  scene.materials.emplace_back().kind = MaterialKind::Emissive;
  scene.materials[0].emissive = dvec3(1);
  scene.materials[0].two_sided = true;
  scene.objects.emplace_back();
  scene.objects[0].material = 0;
  scene.objects[0].shape = DiscShape{dvec3(0), normal, 1};
  scene.objects[0].transform = transform;
  return scene;
}

bool same(const Hit& a, const Hit& b) {
  return a.object == b.object && a.t == b.t && a.position == b.position &&
         a.geometric_normal == b.geometric_normal && a.shading_normal == b.shading_normal &&
         a.tangent == b.tangent && a.u == b.u && a.v == b.v && a.front == b.front &&
         a.triangle == b.triangle && a.position_remainder == b.position_remainder;
}

TEST(RayQueries, ManyAtOnceAreAsManyAlone) {
  for (const char* name : kScenes) {
    const Scene scene = stored_scene(name);
    const std::vector<Ray> rays = picture_rays(scene, 301);
    std::vector<std::optional<Hit>> first;
    for (const KernelKind kind : kernels()) {
      const auto compiled = compile(scene, kind);
      std::vector<std::optional<Hit>> hits(rays.size());
      std::vector<std::uint8_t> blocked(rays.size());
      trace(*compiled, rays, hits);
      occluded(*compiled, rays, blocked);
      int found = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto alone = trace(*compiled, rays[i]);
        ASSERT_EQ(alone.has_value(), hits[i].has_value()) << name;
        EXPECT_EQ(blocked[i] != 0, alone.has_value()) << name;
        if (!alone) continue;
        ++found;
        EXPECT_TRUE(same(*alone, *hits[i])) << name;
        // The float kernels answer alike.
        if (kind != KernelKind::Reference && !first.empty()) {
          EXPECT_TRUE(same(*first[i], *hits[i])) << name;
        }
      }
      EXPECT_GT(found, 30) << name;
      if (first.empty()) first = hits;
    }
  }
}

TEST(RayQueries, TheRayStaysWithinItsEnds) {
  const Scene scene = stored_scene("features/shape-lights.json");
  for (const KernelKind kind : kernels()) {
    const auto compiled = compile(scene, kind);
    int second = 0;
    for (const Ray& ray : picture_rays(scene, 200)) {
      const auto hit = trace(*compiled, ray);
      if (!hit) continue;
      EXPECT_NEAR(glm::length(ray.origin + hit->t * ray.direction - hit->position), 0,
                  1e-4 * glm::length(hit->position - ray.origin));
      Ray part = ray;
      part.t_max = hit->t * 0.999;
      EXPECT_FALSE(trace(*compiled, part).has_value());
      EXPECT_FALSE(occluded(*compiled, part));
      part = ray;
      part.t_min = hit->t * 0.999;
      const auto again = trace(*compiled, part);
      ASSERT_TRUE(again.has_value());
      EXPECT_EQ(again->object, hit->object);
      EXPECT_NEAR(again->t, hit->t, 1e-5 * hit->t);
      part.t_min = hit->t * 1.001;
      const auto behind = trace(*compiled, part);
      if (behind) {
        EXPECT_GE(behind->t, part.t_min);
      }
      second += behind ? 1 : 0;
      part.t_max = part.t_min;
      EXPECT_FALSE(trace(*compiled, part).has_value());
    }
    EXPECT_GT(second, 20);
  }
}

TEST(RayQueries, SpawnedRaysNeverMeetWhatTheyLeft) {
  Random random;
  // Far from 0, where doubles are coarser than the kernel's own points.
  for (const double offset : {0.0, 1e9}) {
    Scene scene;
    scene.materials.resize(1);
    scene.objects.resize(2);
    scene.objects[0].shape = SphereShape{{offset, offset, 0}, 1, {0, 0, 0}};
    scene.objects[1].shape = BoxShape{{offset + 2, offset, 0}, {offset + 3, offset + 1, 1}};
    for (Object& object : scene.objects) object.material = 0;
    for (const KernelKind kind : kernels()) {
      const auto compiled = compile(scene, kind);
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const dvec3 target{offset + random.between(-1, 3), offset + random.between(-1, 1),
                           random.between(-1, 1)};
        Ray ray;
        ray.origin = target + 8.0 * random.direction();
        ray.direction = target - ray.origin;
        const auto hit = trace(*compiled, ray);
        if (!hit) continue;
        ++hits;
        dvec3 away = random.direction();
        if (glm::dot(away, hit->geometric_normal) < 0) away = -away;
        const Ray outward = spawn(*compiled, *hit, away);
        EXPECT_FALSE(outward.from.inside);
        const auto other = trace(*compiled, outward);
        EXPECT_TRUE(!other || other->object != hit->object);
        const Ray inward = spawn(*compiled, *hit, -away);
        EXPECT_TRUE(inward.from.inside);
        const auto exit = trace(*compiled, inward);
        ASSERT_TRUE(exit.has_value()) << "a leak";
        EXPECT_EQ(exit->object, hit->object);
        EXPECT_FALSE(exit->front);
      }
      EXPECT_GT(hits, 500) << kernel_name(kind);
    }
  }
}

TEST(RayQueries, PointsCrossTheBorderUnchanged) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    RenderSpace space;
    space.scale = std::ldexp(1.0, static_cast<int>(random.between(-40, 40)));
    const double distance = std::exp(random.between(-20, 40)) / space.scale;
    space.center = random.direction() * distance;
    const dvec3 q = random.direction() * std::exp(random.between(-20, 2));
    dvec3 p, remainder;
    to_scene(space, q, p, remainder);
    EXPECT_EQ(to_render(space, p, remainder), q);
  }
}

// Float kernels work at unit size, in which scene units are no round numbers: double has bits to
// spare for the way there and back.
TEST(RayQueries, FloatPointsCrossTheBorderAtAnyScaleUnchanged) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    RenderSpace space;
    space.scale = std::exp(random.between(-30, 30));
    space.center = random.direction() * (std::exp(random.between(-20, 15)) / space.scale);
    const glm::vec3 q(random.direction() * std::exp(random.between(-20, 2)));
    dvec3 p, remainder;
    to_scene(space, dvec3(q), p, remainder);
    EXPECT_EQ(glm::vec3(to_render(space, p, remainder)), q);
  }
}

TEST(RayQueries, AMeshNamesItsTriangle) {
  const Scene scene = stored_scene("features/instances.json");
  const auto compiled = compile(scene, KernelKind::Auto);
  int triangles = 0;
  for (const Ray& ray : picture_rays(scene, 300)) {
    const auto hit = trace(*compiled, ray);
    if (!hit) continue;
    const Object& object = scene.objects[static_cast<std::size_t>(hit->object)];
    const auto* shape = std::get_if<MeshShape>(&object.shape);
    ASSERT_EQ(hit->triangle != kNone, shape != nullptr);
    if (shape == nullptr) continue;
    ++triangles;
    const Mesh& mesh = *scene.meshes[static_cast<std::size_t>(shape->mesh)].data;
    ASSERT_LT(hit->triangle, static_cast<int>(mesh.triangles.size()));
    // Leaving that triangle, the ray goes on; leaving another, it meets this one.
    Ray again = ray;
    again.from = {hit->object, hit->triangle, false};
    const auto next = trace(*compiled, again);
    EXPECT_TRUE(!next || next->triangle != hit->triangle || next->object != hit->object);
    again.from.triangle = hit->triangle == 0 ? 1 : 0;
    EXPECT_EQ(trace(*compiled, again)->triangle, hit->triangle);
  }
  EXPECT_GT(triangles, 25);
}

TEST(RayQueries, TheRoundedRayIsTheRayTraced) {
  const Scene scene = stored_scene("cornell-three-lights.json");
  const auto compiled = compile(scene, KernelKind::Scalar);
  for (const Ray& ray : picture_rays(scene, 50)) {
    const Ray seen = as_traced(*compiled, ray);
    EXPECT_NEAR(glm::length(seen.direction), 1, 1e-7);
    const Ray again = as_traced(*compiled, seen);
    EXPECT_EQ(again.origin, seen.origin);
    EXPECT_NEAR(glm::length(seen.origin - ray.origin), 0, 1e-6 * glm::length(ray.origin));
    const auto a = trace(*compiled, ray), b = trace(*compiled, seen);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_NEAR(a->t * glm::length(ray.direction), b->t, 1e-5 * b->t);
    }
  }
}

TEST(RayQueries, SliversOfPyramidsAreMetWhereTheyAre) {
  // The face of vertices 1 to 3 is .85 long and .0006 high. Its plane once was tilted along it.
  Scene scene;
  scene.materials.emplace_back();
  Object object;
  object.name = "pyramid";
  object.material = 0;
  object.shape =
      PyramidShape{{dvec3(1.1469526109960895, 0.66772075586474822, -0.35665148707781363),
                    dvec3(1.9929752818989264, 0.50680153045563558, -0.68972553476287379),
                    dvec3(1.3535190712908953, -0.32749948413690855, -0.25625964334926665),
                    dvec3(1.6736209253759169, 0.090270080001882136, -0.47338623084646458)}};
  scene.objects.push_back(object);
  const Ray ray{dvec3(10.45947663174552, 5.9997511436494273, -12.470954075399847),
                dvec3(-0.5516841359760053, -0.38208284738095327, 0.74138877240599732)};
  const auto hit = trace(*compile(scene, KernelKind::Reference), ray);
  ASSERT_TRUE(hit);
  // From long double; it was 2.4e-13 off.
  EXPECT_NEAR(hit->t, 16.444522742025949, 3e-14);
}

TEST(LightQueries, TurnedDiscsAreSampledAlikeInAnyUnits) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    Transform turned;
    turned.axis = random.direction();
    turned.degrees = random.between(0, 360);
    turned.scale = dvec3(random.between(0.6, 0.9));
    Scene scene = disc_lamp(random.direction(), turned);
    LightQuery query;
    query.u = random.unit();
    query.v = random.unit();
    query.light = 0;
    // Near enough to be sampled by solid angle, where the axes of an ellipse count.
    query.point = random.between(0.1, 0.5) * random.direction();
    LightPoint sample[2];
    for (int k = 0; k < 2; ++k) {
      const auto compiled = compile(scene, KernelKind::Reference);
      sample_lights(*compiled, {&query, 1}, {&sample[k], 1});
      scene.objects[0].transform.scale *= 1e-4;
      query.point *= 1e-4;
    }
    ASSERT_EQ(sample[0].valid, sample[1].valid);
    EXPECT_LT(glm::length(sample[0].direction - sample[1].direction), 1e-9);
  }
}

TEST(LightQueries, DiscsAreSampledEvenlyFromAnywhere) {
  const auto compiled = compile(disc_lamp({0, 0, 1}), KernelKind::Reference);
  constexpr int kSide = 32;
  const auto variance = [&](const dvec3& point, const dvec3& normal) {
    std::vector<LightQuery> queries(kSide * kSide);
    for (int i = 0; i < kSide * kSide; ++i) {
      LightQuery& q = queries[static_cast<std::size_t>(i)];
      q.point = point;
      q.u = (i / kSide + 0.5) / kSide;
      q.v = (i % kSide + 0.5) / kSide;
      q.light = 0;
    }
    std::vector<LightPoint> samples(queries.size());
    sample_lights(*compiled, queries, samples);
    double sum = 0, squares = 0;
    for (const LightPoint& s : samples) {
      const double value = s.valid ? std::max(glm::dot(s.direction, normal), 0.0) / s.pdf : 0;
      sum += value;
      squares += value * value;
    }
    return squares * kSide * kSide / (sum * sum) - 1;
  };
  for (double angle = 0; angle < 1.56; angle += 0.05) {
    for (double away = 0.3; away < 4; away *= 1.1) {
      const dvec3 point = away * dvec3(std::sin(angle), 0, std::cos(angle));
      // Nearer by, much of the disc is below the horizon of one that faces its middle.
      if (away > 1.7) {
        EXPECT_LT(variance(point, -glm::normalize(point)), 0.5) << angle << " " << away;
      }
      if (point.x < 1) {
        EXPECT_LT(variance(point, dvec3(0, 0, -1)), 0.5) << angle << " " << away;
      }
    }
  }
}

/// The mean of 1 / pdf over some random numbers, in float over that in double.
double float_angle_over_double(const Scene& scene, const dvec3& from) {
  std::vector<LightQuery> queries(64);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    queries[i] = {from, (static_cast<double>(i) + 0.5) / 64, 0.3, 0, 0, 0};
  }
  double sum[2] = {};
  for (int k = 0; k < 2; ++k) {
    const auto compiled =
        compile(scene, best_kernel(k == 0 ? Precision::Float : Precision::Double));
    std::vector<LightPoint> samples(queries.size());
    sample_lights(*compiled, queries, samples);
    for (const LightPoint& s : samples) sum[k] += 1 / s.pdf;
  }
  return sum[0] / sum[1];
}

// Seen from near an edge the terms that divide the determinant cancel to a tenth.
TEST(LightQueries, FlatPyramidsHaveTheirSolidAngleInFloat) {
  Scene scene = disc_lamp({0, 0, 1});
  scene.objects[0].shape = PyramidShape{{dvec3{-0.015625, 0.96875, -0.24609375},
                                         {0.7705078125, 0.552734375, 0.3173828125},
                                         {-0.5947265625, -0.7998046875, -0.0830078125},
                                         {-0.10546875, -2.8544921875, 0.7685546875}}};
  const dvec3 from{-0.49183778290171165, -1.625309556722641, 0.3156578966854795};
  EXPECT_NEAR(float_angle_over_double(scene, from), 1, 1e-6);
}

// By way of the point in the cylinder's own space it was up to 5e-6 off.
TEST(LightQueries, SkewedCylindersHaveTheirSolidAngleInFloat) {
  Random random;
  double worst = 0;
  for (int i = 0; i < 40000; ++i) {
    Transform squeezed;
    squeezed.scale = {random.between(0.3, 1.2), random.between(0.3, 1.2), random.between(0.3, 1.2)};
    squeezed.axis = random.direction();
    squeezed.degrees = random.between(0, 360);
    Scene scene = disc_lamp({0, 0, 1}, squeezed);
    const dvec3 end = random.between(0.2, 1) * random.direction();
    scene.objects[0].shape = CylinderShape{-end, end, random.between(0.3, 0.6)};
    const dvec3 from = std::pow(10, random.between(0.5, 4)) * random.direction();
    worst = std::max(worst, std::abs(float_angle_over_double(scene, from) - 1));
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(LightQueries, EllipsesAreHitFromNearTheirRim) {
  Random random;
  for (int i = 0; i < 4000; ++i) {
    const double narrow = random.between(0.25, 1);
    Transform squeezed;
    squeezed.scale = dvec3(1, narrow, 1);
    const auto compiled = compile(disc_lamp({0, 0, 1}, squeezed), KernelKind::Reference);
    const double a = random.between(0, 6.283185307179586),
                 away = std::pow(10, random.between(-3, -1));
    const dvec3 out = glm::normalize(dvec3(std::cos(a) * narrow, std::sin(a), 0));
    const double tilt = std::pow(10, random.between(-4, 0.4));
    LightQuery query;
    query.point = dvec3(std::cos(a), std::sin(a) * narrow, 0) +
                  away * (std::cos(tilt) * out + dvec3(0, 0, std::sin(tilt)));
    query.light = 0;
    query.u = random.between(0.05, 0.95);
    query.v = random.between(0.05, 0.95);
    LightPoint sample, seen;
    sample_lights(*compiled, {&query, 1}, {&sample, 1});
    ASSERT_TRUE(sample.valid);
    const LightDirection direction{query.point, sample.direction, 0};
    pdf_lights(*compiled, {&direction, 1}, {&seen, 1});
    EXPECT_TRUE(seen.valid) << "away " << away << " tilt " << tilt << " narrow " << narrow;
  }
}

TEST(LightQueries, SamplesHaveTheDensityThatTheirDirectionIsGiven) {
  for (const char* name : {"cornell-three-lights.json", "features/shape-lights.json"}) {
    const Scene scene = stored_scene(name);
    for (const KernelKind kind : kernels()) {
      const auto compiled = compile(scene, kind);
      ASSERT_GT(light_count(*compiled), 1) << name;
      double total = 0;
      for (int i = 0; i < light_count(*compiled); ++i) {
        total += light_source(*compiled, i).selection;
        const int object = light_source(*compiled, i).object;
        const int material = scene.objects[static_cast<std::size_t>(object)].material;
        EXPECT_TRUE(emits(scene.materials[static_cast<std::size_t>(material)]));
      }
      EXPECT_NEAR(total, 1, 1e-5);
      Random random;
      std::vector<LightQuery> queries(500);
      for (LightQuery& q : queries) {
        q.point = scene.camera.look_at + random.between(0, 1) * random.direction();
        q.u = random.unit();
        q.v = random.unit();
        q.choice = random.unit();
      }
      queries[0].u = queries[0].v = queries[0].choice = 1 - 0x1p-53;
      std::vector<LightPoint> samples(queries.size()), seen(queries.size());
      sample_lights(*compiled, queries, samples);
      std::vector<LightDirection> directions(queries.size());
      for (std::size_t i = 0; i < queries.size(); ++i) {
        directions[i] = {queries[i].point, samples[i].valid ? samples[i].direction : dvec3(1, 0, 0),
                         std::max(samples[i].light, 0)};
      }
      pdf_lights(*compiled, directions, seen);
      int compared = 0;
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const LightPoint &a = samples[i], &b = seen[i];
        if (!a.valid || !b.valid) continue;
        // Samples on the far side of a solid are met on the near one.
        if (std::abs(a.distance / b.distance - 1) > 1e-3 || glm::dot(a.normal, b.normal) < 0.99) {
          continue;
        }
        ++compared;
        EXPECT_EQ(a.light, b.light);
        EXPECT_NEAR(a.selection, b.selection, 1e-6);
        EXPECT_EQ(a.radiance == dvec3(0), b.radiance == dvec3(0));
        EXPECT_NEAR(glm::dot(a.direction, a.direction), 1, 1e-6);
        EXPECT_NEAR(b.pdf / a.pdf, 1, 1e-2) << name << " " << kernel_name(kind);
      }
      EXPECT_GT(compared, 200) << name;
    }
  }
}

TEST(LightQueries, WithoutANameTheNearestSurfaceAnswers) {
  const Scene scene = stored_scene("cornell-three-lights.json");
  const auto compiled = compile(scene, KernelKind::Auto);
  int lights = 0, others = 0;
  for (const Ray& ray : picture_rays(scene, 2000)) {
    LightDirection query{ray.origin, ray.direction};
    LightPoint point;
    pdf_lights(*compiled, {&query, 1}, {&point, 1});
    const auto hit = trace(*compiled, ray);
    const int material =
        hit ? scene.objects[static_cast<std::size_t>(hit->object)].material : kNone;
    const bool light =
        material != kNone && emits(scene.materials[static_cast<std::size_t>(material)]);
    ASSERT_EQ(point.valid, light);
    ++(light ? lights : others);
    if (light) {
      EXPECT_EQ(light_source(*compiled, point.light).object, hit->object);
    }
  }
  EXPECT_GT(lights, 20);
  EXPECT_GT(others, 20);
}

TEST(BsdfQueries, WeightTimesDensityIsTheValue) {
  Scene scene;  // with materials that no object has
  const auto add = [&](MaterialKind kind, auto... set) {
    Material m;
    m.kind = kind;
    m.base_color = {0.9, 0.5, 0.2};
    (set(m), ...);
    scene.materials.push_back(m);
  };
  add(MaterialKind::Lambertian);
  add(MaterialKind::Metal, [](Material& m) { m.roughness = 0.4; });
  add(MaterialKind::Metal, [](Material& m) { m.fuzz = 0.3; });
  add(MaterialKind::Metal);
  add(MaterialKind::Dielectric);
  for (const KernelKind kind : kernels()) {
    const auto compiled = compile(scene, kind);
    Random random;
    std::vector<BsdfQuery> queries(1000);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      BsdfQuery& q = queries[i];
      q.material = static_cast<int>(i % 5);
      q.normal = random.direction();
      q.wo = random.direction() * 3.0;
      q.u = random.unit();
      q.v = random.unit();
      q.lobe = random.unit();
    }
    std::vector<BsdfSample> samples(queries.size());
    sample_bsdf(*compiled, queries, samples);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      queries[i].wi = samples[i].valid ? samples[i].wi : queries[i].normal;
    }
    std::vector<BsdfValue> values(queries.size());
    eval_bsdf(*compiled, queries, values);
    int valid = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const BsdfSample& s = samples[i];
      if (!s.valid) continue;
      ++valid;
      EXPECT_EQ(s.delta, queries[i].material >= 3);
      if (s.delta) {
        EXPECT_EQ(values[i].pdf, 0);
        continue;
      }
      // As far as a density may differ that knows the direction rounded only.
      EXPECT_NEAR(values[i].pdf / s.pdf, 1, 2e-2);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(s.weight[k] * values[i].pdf, values[i].value[k], 1e-4 * values[i].pdf);
      }
    }
    EXPECT_GT(valid, 800);
  }
}

// Half vectors of grazing directions are short: of float directions turned into the frame before
// they are summed, densities were off by up to 16 %.
TEST(BsdfQueries, NarrowLobesAtGrazingAnglesAreWhereDoubleHasThem) {
  constexpr double kAlpha = 1e-3, kCosine = 1e-3;
  Scene scene;
  scene.materials.emplace_back().kind = MaterialKind::Metal;
  scene.materials.back().roughness = std::sqrt(kAlpha);
  const auto narrow = compile(scene, best_kernel(Precision::Float));
  const auto wide = compile(scene, best_kernel(Precision::Double));
  const auto rounded = [](const dvec3& v) { return dvec3(glm::vec3(v)); };
  Random random;
  std::vector<BsdfQuery> queries(4000);
  for (BsdfQuery& q : queries) {
    const dvec3 n = random.direction(), x = glm::normalize(glm::cross(n, random.direction()));
    const dvec3 y = glm::cross(n, x);
    const double tilt = kAlpha * random.unit(), phi = random.between(0, 6.283185307179586);
    const dvec3 h = glm::normalize(n + tilt * (std::cos(phi) * x + std::sin(phi) * y));
    const dvec3 wo = glm::normalize(kCosine * n + x);
    q = {0, rounded(n), rounded(wo), rounded(2 * glm::dot(wo, h) * h - wo), 0, 0, 0};
  }
  std::vector<BsdfValue> values(queries.size()), exact(queries.size());
  eval_bsdf(*narrow, queries, values);
  eval_bsdf(*wide, queries, exact);
  int compared = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (glm::dot(queries[i].wi, queries[i].normal) < 0.1 * kCosine) continue;
    EXPECT_NEAR(values[i].pdf / exact[i].pdf, 1, 0.01);
    ++compared;
  }
  EXPECT_GT(compared, 3000);
}

TEST(BsdfQueries, TheLastSampleAboveTheSurfaceHasADensity) {
  Scene scene;
  for (const double width : {0.7, 1.0}) {
    scene.materials.emplace_back().kind = MaterialKind::Metal;
    scene.materials.back().roughness = width;
    scene.materials.emplace_back().kind = MaterialKind::Metal;
    scene.materials.back().fuzz = width;
  }
  const auto compiled = compile(scene, best_kernel(Precision::Float));
  Random random;
  int found = 0;
  for (int i = 0; i < 40000; ++i) {
    BsdfQuery query{i % 4, random.direction(), random.direction(), {},
                    0,     random.unit(),      random.unit()};
    const auto sample = [&](double u) {
      query.u = u;
      BsdfSample s;
      sample_bsdf(*compiled, {&query, 1}, {&s, 1});
      return s;
    };
    // By halving between a number that gives a sample and one that is absorbed.
    double valid = 0.5, absorbed = random.unit();
    if (!sample(valid).valid || sample(absorbed).valid) continue;
    while (std::abs(valid - absorbed) > 0x1p-24) {
      const double middle = 0.5 * (valid + absorbed);
      (sample(middle).valid ? valid : absorbed) = middle;
    }
    query.wi = sample(valid).wi;
    BsdfValue value;
    eval_bsdf(*compiled, {&query, 1}, {&value, 1});
    EXPECT_GT(value.pdf, 0);
    ++found;
  }
  EXPECT_GT(found, 800);
}

}  // namespace
}  // namespace lightbench
