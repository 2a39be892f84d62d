// Closest hits of every shape under every kind of transform, through the public interface and in
// every kernel, against textbook algebra in object space (shape_oracle.h).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <random>

#include "core/query/rays.h"
#include "core/scene/bounds.h"
#include "core/scene/transform.h"
#include "tests/unit/shape_gallery.h"
#include "tests/unit/shape_oracle.h"

namespace lightbench {
namespace {

using glm::dvec3;

/// A shape under a transform, with its oracle and every kernel's idea of it.
struct Subject {
  std::string name;
  Scene scene;
  glm::dmat4 to_world, to_object;
  Bounds box;
  double size;  ///< half its diagonal

  [[nodiscard]] const Object& object() const { return scene.objects[0]; }

  [[nodiscard]] std::optional<OracleHit> oracle(const Ray& ray) const {
    auto hit = oracle_hit(object().shape, *gallery_mesh(), transform_point(to_object, ray.origin),
                          transform_vector(to_object, ray.direction), ray.time);
    if (!hit) return hit;
    hit->p = transform_point(to_world, hit->p);
    hit->n = glm::normalize(dvec3(glm::transpose(to_object) * glm::dvec4(hit->n, 0)));
    return hit;
  }
};

Subject subject_of(const NamedShape& shape, const NamedTransform& transform) {
  Subject s;
  s.name = shape.name + ", " + transform.name;
  s.scene = scene_of(shape.shape, transform.transform);
  s.to_world = object_to_world(transform.transform);
  s.to_object = glm::inverse(s.to_world);
  s.box = object_bounds(s.object(), s.scene.camera, all_mesh_bounds(s.scene));
  s.size = 0.5 * glm::length(s.box.size());
  return s;
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low = 0, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  dvec3 direction() {
    const double z = (*this)(-1, 1), phi = (*this)(0, 6.283185307179586);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  dvec3 within(const Bounds& b, double margin) {
    const dvec3 w{(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)};
    return b.center() + 0.5 * (1 + margin) * w * b.size();
  }
};

/// From outside and inside, aimed at it and past it, along axes of the world and of the object, and
/// along its surface. Directions are not unit.
std::vector<Ray> rays_at(const Subject& s) {
  Random random{std::mt19937_64(std::hash<std::string>{}(s.name) & 0xffff)};
  std::vector<Ray> rays;
  const dvec3 center = s.box.center();
  const auto add = [&](const dvec3& origin, const dvec3& direction) {
    rays.push_back({origin, direction * (s.size * random(0.2, 3)), 1e300, random()});
  };
  for (int k = 0; k < 60; ++k) {
    const dvec3 origin = center + random.direction() * (s.size * random(1.1, 8));
    add(origin, glm::normalize(random.within(s.box, 0) - origin));
    add(origin, glm::normalize(random.within(s.box, 0.5) - origin));
    add(random.within(s.box, -0.3), random.direction());
    const int axis = k % 3;
    dvec3 along(0);
    along[axis] = k % 2 == 0 ? 1 : -1;
    const dvec3 p = random.within(s.box, 0.05);
    add(p - along * (3 * s.size), along);
    add(p, along);
    const dvec3 object_axis = glm::normalize(transform_vector(s.to_world, along));
    add(p - object_axis * (3 * s.size), object_axis);
  }
  // Grazing: along the tangent plane of a point that the oracle finds, just above and below it.
  const std::size_t found = rays.size();
  for (std::size_t k = 0; k < found; k += 6) {
    const auto hit = s.oracle(rays[k]);
    if (!hit) continue;
    const dvec3 t = glm::normalize(glm::cross(hit->n, random.direction()));
    for (const double height : {1e-2, -1e-2, 1e-4, -1e-4}) {
      add(hit->p + hit->n * (height * s.size) - t * (2 * s.size), t);
    }
    rays.back().time = rays[rays.size() - 2].time = rays[k].time;
  }
  return rays;
}

/// What the kernels may be off by, relative to the size of things: rounding, no more.
double tolerance_of(KernelKind kernel) {
  return precision_of(kernel) == Precision::Double ? 2e-13 : 3e-6;
}

double world_rounding(const Subject& s, const Ray& ray) {
  return 2e-15 * (glm::length(s.box.center()) + glm::length(ray.origin));
}

/// Empty if the hit is the oracle's.
std::string disagreement(const Subject& s, const Ray& ray, const std::optional<Hit>& hit,
                         const std::optional<OracleHit>& expected, double tolerance) {
  if (hit.has_value() != expected.has_value()) return hit ? "hit, should miss" : "missed";
  if (!hit) return "";
  const double length = glm::length(ray.direction);
  const dvec3 d = ray.direction / length;
  const double cosine = std::abs(glm::dot(d, expected->n));
  const double reach = s.size + glm::length(ray.origin - s.box.center());
  // World coordinates are doubles themselves: far from the origin a small object knows no better.
  const double slack = tolerance * reach + world_rounding(s, ray);
  if (std::abs(hit->t - expected->t) * length * cosine > slack + 1e-9 * tolerance) {
    return "t " + std::to_string(hit->t) + " for " + std::to_string(expected->t);
  }
  // Beyond the plane through the right point by no more than rounding, and on the ray.
  if (std::abs(glm::dot(hit->position - expected->p, expected->n)) > slack)
    return "off the surface";
  if (glm::length(hit->position - expected->p) * cosine > 2 * slack) return "off the point";
  // How far a normal may turn: as far as a displacement along the surface turns it.
  const double bend = std::min(1.0, slack / (cosine + 1e-300) / (0.02 * s.size));
  if (glm::length(hit->geometric_normal - expected->n) > 8 * tolerance + bend) return "normal";
  if (cosine > 1e-3 && hit->front != (glm::dot(d, expected->n) < 0)) return "front";
  if (hit->object != 0) return "object";
  return "";
}

void for_each_kernel(const std::function<void(KernelKind)>& f) {
  for (const KernelKind kernel : kKernels) {
    if (kernel_supported(kernel)) f(kernel);
  }
}

/// The ray moved sideways by rounding, eight ways and not at all.
std::vector<Ray> neighbours(const Ray& ray, double step) {
  const dvec3 d = glm::normalize(ray.direction);
  const dvec3 x =
      glm::normalize(glm::cross(d, std::abs(d.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 y = glm::cross(d, x);
  std::vector<Ray> r{ray};
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      r.push_back(ray);
      r.back().origin += step * (double(i) * x + double(j) * y);
    }
  }
  return r;
}

void check_hits(const Subject& s, KernelKind kernel) {
  const auto scene = compile(s.scene, kernel);
  const double tolerance = tolerance_of(kernel);
  int hits = 0, wrong = 0;
  for (const Ray& ray : rays_at(s)) {
    const auto hit = trace(*scene, ray);
    hits += hit ? 1 : 0;
    const double reach = s.size + glm::length(ray.origin - s.box.center());
    std::string why;
    // At an edge rounding decides: the answer must be right for a ray within rounding of this one.
    for (const Ray& near : neighbours(ray, 4 * tolerance * reach + world_rounding(s, ray))) {
      why = disagreement(s, ray, hit, s.oracle(near), 8 * tolerance);
      if (why.empty()) break;
    }
    if (!why.empty() && ++wrong <= 3) {
      const auto plain = s.oracle(ray);
      ADD_FAILURE() << s.name << " in " << kernel_name(kernel) << ": "
                    << disagreement(s, ray, hit, plain, 8 * tolerance) << "; ray from "
                    << ray.origin.x << " " << ray.origin.y << " " << ray.origin.z << " along "
                    << ray.direction.x << " " << ray.direction.y << " " << ray.direction.z
                    << " time " << ray.time;
    }
    EXPECT_EQ(occluded(*scene, ray), hit.has_value()) << s.name;
    if (!hit) continue;
    Ray shorter = ray;
    shorter.t_max = hit->t * 0.999;
    EXPECT_FALSE(occluded(*scene, shorter)) << s.name << ": something before the closest hit";
    EXPECT_FALSE(trace(*scene, shorter).has_value()) << s.name;
    shorter.t_max = hit->t * 1.001;
    EXPECT_TRUE(occluded(*scene, shorter)) << s.name;
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(hit->position[k], s.box.min[k] - 8 * tolerance * s.size - world_rounding(s, ray))
          << s.name << ": outside its bounds";
      EXPECT_LE(hit->position[k], s.box.max[k] + 8 * tolerance * s.size + world_rounding(s, ray))
          << s.name << ": outside its bounds";
    }
    EXPECT_NEAR(glm::length(hit->geometric_normal), 1, 2 * tolerance) << s.name;
    EXPECT_NEAR(glm::length(hit->tangent), 1, 2 * tolerance) << s.name;
    EXPECT_NEAR(glm::dot(hit->tangent, hit->geometric_normal), 0, 40 * tolerance) << s.name;
    if (std::holds_alternative<MeshShape>(s.object().shape)) continue;
    EXPECT_EQ(hit->shading_normal, hit->geometric_normal) << s.name;
  }
  EXPECT_EQ(wrong, 0) << s.name << " in " << kernel_name(kernel);
  EXPECT_GT(hits, 40) << s.name << ": the test has no power here";
}

class ShapeHits : public testing::TestWithParam<NamedShape> {};

TEST_P(ShapeHits, AreThoseOfTheTextbookInEveryKernel) {
  for (const NamedTransform& transform : gallery_transforms()) {
    const Subject s = subject_of(GetParam(), transform);
    for_each_kernel([&](KernelKind kernel) { check_hits(s, kernel); });
  }
}

TEST_P(ShapeHits, CarryTheTextureCoordinatesOfTheObject) {
  for (const NamedTransform& transform : gallery_transforms()) {
    const Subject s = subject_of(GetParam(), transform);
    const auto scene = compile(s.scene, KernelKind::Reference);
    int compared = 0, wrong = 0;
    for (const Ray& ray : rays_at(s)) {
      const auto hit = trace(*scene, ray);
      const auto expected = s.oracle(ray);
      if (!hit || !expected) continue;
      EXPECT_TRUE(hit->u >= 0 && hit->u <= 1 + 1e-12 && hit->v >= 0 && hit->v <= 1 + 1e-12)
          << s.name << " uv " << hit->u << " " << hit->v;
      const dvec3 d = glm::normalize(ray.direction);
      if (std::abs(glm::dot(d, expected->n)) < 0.01) continue;
      ++compared;
      const double v_gap = std::abs(hit->v - expected->v);
      // u has no meaning at a pole, and wraps.
      double u_gap = std::abs(hit->u - expected->u);
      u_gap = std::min(u_gap, 1 - u_gap);
      const bool pole = expected->v < 0.01 || expected->v > 0.99;
      if ((expected->has_v && v_gap > 1e-8) || (expected->has_u && u_gap > 1e-8 && !pole)) {
        if (++wrong <= 2) {
          ADD_FAILURE() << s.name << ": uv " << hit->u << " " << hit->v << " for " << expected->u
                        << " " << expected->v;
        }
      }
    }
    EXPECT_GT(compared, 50) << s.name;
  }
}

/// Where the ray that is displaced along the tangent hits, u is larger.
TEST_P(ShapeHits, TangentsPointAlongGrowingU) {
  for (const NamedTransform& transform : gallery_transforms()) {
    const Subject s = subject_of(GetParam(), transform);
    const auto scene = compile(s.scene, KernelKind::Reference);
    int compared = 0;
    for (const Ray& ray : rays_at(s)) {
      const auto hit = trace(*scene, ray);
      if (!hit || std::abs(glm::dot(glm::normalize(ray.direction), hit->geometric_normal)) < 0.05)
        continue;
      const double step = 1e-5 * s.size;
      // Head on, from the side it was seen from.
      const dvec3 n = hit->front ? hit->geometric_normal : -hit->geometric_normal;
      Ray beside;
      beside.origin = hit->position + step * hit->tangent + 1e-3 * s.size * n;
      beside.direction = -n;
      beside.time = ray.time;
      const auto other = trace(*scene, beside);
      if (!other || other->front != hit->front ||
          glm::length(other->geometric_normal - hit->geometric_normal) > 0.01 ||
          glm::length(other->position - beside.origin) > 2e-3 * s.size)
        continue;
      double du = other->u - hit->u;
      du -= std::round(du);
      if (std::abs(hit->v - 0.5) > 0.499 || std::abs(du) > 0.01) continue;  // a pole, or an edge
      ++compared;
      ASSERT_GT(du, 0) << s.name << " at uv " << hit->u << " " << hit->v;
    }
    EXPECT_GT(compared, 30) << s.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShapeHits, testing::ValuesIn(shape_gallery()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST(Shape, PutsTheBooksEarthTheRightWayUp) {
  // Seen from +z: the centre of the map is where x grows to the right from -x (u = 0) over +z.
  const auto scene = compile(scene_of(SphereShape{}, {}), KernelKind::Reference);
  const auto at = [&](const dvec3& from) { return *trace(*scene, {from, -from}); };
  EXPECT_NEAR(at({0, 0, 3}).u, 0.25, 1e-12);
  EXPECT_NEAR(at({3, 0, 0}).u, 0.5, 1e-12);
  EXPECT_NEAR(at({0, 0, -3}).u, 0.75, 1e-12);
  EXPECT_NEAR(at({0, 3, 0}).v, 1, 1e-12);
  EXPECT_NEAR(at({0, -3, 0}).v, 0, 1e-12);
}

TEST(Shape, FarAndTinySpheresKeepTheirOutline) {
  // Where the textbook quadratic in the kernel's own precision is noise: distance over radius 1e4
  // in float and 1e8 in double. Rays aimed at 0.99 and 1.01 of the radius tell.
  for_each_kernel([](KernelKind kernel) {
    const double distance = precision_of(kernel) == Precision::Double ? 1e8 : 1e4;
    const auto scene = compile(scene_of(SphereShape{}, {}), kernel);
    for (int k = 0; k < 200; ++k) {
      const double phi = 0.0314 * k;
      const auto hit = [&](double r) {
        Ray ray;
        ray.origin = {r * std::cos(phi), r * std::sin(phi), distance};
        return trace(*scene, ray).has_value();
      };
      EXPECT_TRUE(hit(0.99)) << kernel_name(kernel);
      EXPECT_FALSE(hit(1.01)) << kernel_name(kernel);
    }
  });
}

}  // namespace
}  // namespace lightbench
