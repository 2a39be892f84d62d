#include "core/compile/lenses.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lightbench {
namespace {

using glm::dvec3;

double square(double x) { return x * x; }

/// Fresnel's reflectance of glass for light that comes from outside.
double reflectance(double cosine, double ior) {
  const double beyond = std::sqrt(1 - (1 - square(cosine)) / square(ior));
  const double p = (ior * cosine - beyond) / (ior * cosine + beyond);
  const double s = (cosine - ior * beyond) / (cosine + ior * beyond);
  return 0.5 * (p * p + s * s);
}

/// How far a ray at incidence theta is turned on its way through, less the angle at which it then
/// stands to the line from the sphere's centre to the lamp's.
double turn(const Lamp& lamp, const GlassSphere& sphere, double theta) {
  const double k = sphere.radius / glm::distance(lamp.place.center, sphere.middle());
  const double s = std::sin(theta);
  return 2 * theta - 2 * std::asin(s / sphere.ior) - std::asin(std::min(s * k, 1.0));
}

}  // namespace

template <class T>
std::vector<GlassSphere> glass_spheres(const Scene& scene, const GeometryPart<T>& geometry,
                                       const ObjectBoxes& boxes) {
  std::vector<GlassSphere> spheres;
  unsigned seen = 0;
  for (std::uint32_t i = 0; i < geometry.surface_count && seen < kMaxWithImages; ++i) {
    if (static_cast<PrimitiveKind>(geometry.kind[i]) != PrimitiveKind::Sphere) continue;
    const auto object = static_cast<std::size_t>(geometry.object[i]);
    const Material& m = scene.materials[static_cast<std::size_t>(scene.objects[object].material)];
    if (!is_clear_glass(m)) continue;
    ++seen;
    const Interior interior = boxes.interior(object);
    if (interior == Interior::Hollow) continue;
    const Numbers<T> row(&geometry.rows[geometry.row[i]]);
    spheres.push_back({row.vec(0), row.vec(4), row[3], m.ior, i, m.base_color * m.base_color,
                       interior == Interior::Crowded});
  }
  return spheres;
}

bool can_light(const Lamp& lamp, const GlassSphere& sphere) {
  const double reach = lamp.place.radius() + 0.5 * glm::length(sphere.motion) + sphere.radius;
  return glm::distance(lamp.place.center, sphere.middle()) > reach;
}

std::array<double, kLensNodes> lens_turns(const Lamp& lamp, const GlassSphere& sphere) {
  std::array<double, kLensNodes> turns{};
  for (unsigned j = 0; j < kLensNodes; ++j) {
    turns[j] = turn(lamp, sphere, (j + 1) * std::numbers::pi / (2 * kLensNodes));
  }
  return turns;
}

std::vector<double> lens_table(const Lamp& lamp, const GlassSphere& sphere) {
  constexpr unsigned kSteps = 24;  // of the angle of incidence
  const LightPlacement& p = lamp.place;
  const dvec3 way = p.center - sphere.middle();
  const double distance = glm::length(way), radius = p.radius();
  const double reach = std::asin(std::min(radius / distance, 1.0));
  // How much of its face a flat lamp shows the sphere.
  double facing = 1;
  if (p.normal != dvec3(0)) {
    facing = -glm::dot(p.normal, way) / distance;
    facing = std::clamp(lamp.two_sided ? std::abs(facing) : facing, 0.0, 1.0);
  }
  const double radiance =
      lamp.weight * luminance(sphere.tint) / (std::numbers::pi * radius * radius) * facing;
  std::array<double, kSteps + 1> sine{}, turned{}, passing{};
  for (unsigned j = 0; j <= kSteps; ++j) {
    const double theta = j * std::numbers::pi / (2 * kSteps);
    sine[j] = std::sin(theta);
    turned[j] = turn(lamp, sphere, theta);
    passing[j] = square(1 - reflectance(std::cos(theta), sphere.ior));
  }
  std::vector<double> table(kLensCells);
  for (unsigned i = 0; i < kLensNearness; ++i) {
    const double k = (i + 0.5) / kLensNearness;
    std::array<double, kSteps + 1> g{};
    for (unsigned j = 0; j <= kSteps; ++j) g[j] = turned[j] - std::asin(k * sine[j]);
    for (unsigned a = 0; a < kLensAngles; ++a) {
      const double angle = 2 * std::asin((a + 0.5) / kLensAngles);
      const double around = std::sin(reach) / std::sin(angle);
      const bool ahead = around >= 1;
      const double half = ahead ? std::numbers::pi : std::asin(around);
      const double low = ahead ? 0 : angle - reach, high = angle + reach;
      double total = 0;
      for (unsigned j = 0; j < kSteps; ++j) {
        const double from = std::min(g[j], g[j + 1]), to = std::max(g[j], g[j + 1]);
        const auto share = [&](double lower, double upper) {
          return std::max(std::min(to, upper) - std::max(from, lower), 0.0) /
                 std::max(to - from, 1e-9);
        };
        total += (share(low, high) + share(-high, -low)) * (square(sine[j + 1]) - square(sine[j])) *
                 0.5 * (passing[j] + passing[j + 1]);
      }
      table[i * kLensAngles + a] = radiance * k * k * total * half;
    }
  }
  return table;
}

template <class T>
void append_lens(const GlassSphere& sphere, T offset, std::vector<T>& rows) {
  const double numbers[kLensStride] = {sphere.center.x,
                                       sphere.center.y,
                                       sphere.center.z,
                                       sphere.motion.x,
                                       sphere.motion.y,
                                       sphere.motion.z,
                                       sphere.radius,
                                       sphere.ior,
                                       double(sphere.primitive),
                                       static_cast<double>(offset),
                                       sphere.tint.x,
                                       sphere.tint.y,
                                       sphere.tint.z,
                                       sphere.crowded ? 1.0 : 0.0};
  for (const double x : numbers) rows.push_back(static_cast<T>(x));
}

template std::vector<GlassSphere> glass_spheres(const Scene&, const GeometryPart<float>&,
                                                const ObjectBoxes&);
template std::vector<GlassSphere> glass_spheres(const Scene&, const GeometryPart<double>&,
                                                const ObjectBoxes&);
template void append_lens(const GlassSphere&, float, std::vector<float>&);
template void append_lens(const GlassSphere&, double, std::vector<double>&);

}  // namespace lightbench
