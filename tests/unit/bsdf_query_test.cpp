// BSDFs put to compiled scenes: samples, values and densities that belong together.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/query/materials.h"
#include "tests/unit/query_support.h"

namespace lightbench {
namespace {

using glm::dvec3;

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
      q.w = random.unit();
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
