#include "app/proof/closed_forms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lightbench::proof {
namespace {

using glm::cross;
using glm::dot;
using glm::dvec2;
using glm::dvec3;
constexpr double kPi = std::numbers::pi;

/// The part of the polygon above the receiver's plane (Sutherland and Hodgman).
std::vector<dvec3> clip_at_horizon(const Receiver& r, const std::vector<dvec3>& corners) {
  std::vector<dvec3> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
    const double ha = dot(a - r.position, r.normal), hb = dot(b - r.position, r.normal);
    if (ha > 0) kept.push_back(a);
    if ((ha > 0) != (hb > 0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  return kept;
}

}  // namespace

double polygon_irradiance(const Receiver& receiver, std::vector<dvec3> corners) {
  corners = clip_at_horizon(receiver, corners);
  if (corners.size() < 3) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = glm::normalize(corners[i] - receiver.position);
    const dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - receiver.position);
    const dvec3 n = cross(a, b);
    const double sine = glm::length(n);
    if (sine > 0) sum += std::atan2(sine, dot(a, b)) * dot(n / sine, receiver.normal);
  }
  return std::abs(sum) / 2;
}

double polyhedron_irradiance(const Receiver& receiver,
                             const std::vector<std::vector<dvec3>>& faces) {
  double sum = 0;
  for (const std::vector<dvec3>& f : faces) {
    const dvec3 outward = cross(f[1] - f[0], f[2] - f[0]);
    if (dot(outward, receiver.position - f[0]) > 0) sum += polygon_irradiance(receiver, f);
  }
  return sum;
}

double patch_irradiance(const Receiver& receiver, const std::vector<EmittingPatch>& patches,
                        int n) {
  const double cell = 1.0 / n, h = 1e-5;
  double sum = 0;
  for (const EmittingPatch& patch : patches) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const dvec2 u((i + 0.5) * cell, (j + 0.5) * cell);
        const dvec3 du = patch.point(u + dvec2(h, 0)) - patch.point(u - dvec2(h, 0));
        const dvec3 dv = patch.point(u + dvec2(0, h)) - patch.point(u - dvec2(0, h));
        const dvec3 area = cross(du, dv) * ((patch.flipped ? -1 : 1) * (cell * cell / (4 * h * h)));
        const dvec3 w = patch.point(u) - receiver.position;
        const double leaving = -dot(w, area), arriving = dot(w, receiver.normal);
        if (leaving <= 0 || arriving <= 0) continue;
        const double d2 = dot(w, w);
        sum += patch.radiance(u) * leaving * arriving / (d2 * d2);
      }
    }
  }
  return sum;
}

double disc_share_beyond(double s) {
  s = std::clamp(s, -1.0, 1.0);
  return 0.5 - (std::asin(s) + s * std::sqrt(1 - s * s)) / kPi;
}

double fresnel(double cosine, double eta) {
  const double sine_beyond = std::sqrt(1 - cosine * cosine) / eta;
  if (sine_beyond >= 1) return 1;
  const double beyond = std::sqrt(1 - sine_beyond * sine_beyond);
  const double s = (cosine - eta * beyond) / (cosine + eta * beyond);
  const double p = (eta * cosine - beyond) / (eta * cosine + beyond);
  return (s * s + p * p) / 2;
}

double ggx_albedo(double cosine, double alpha) {
  // Over half vectors h weighted by D cos: tan(theta_h) = alpha sqrt(u / (1 - u)), phi uniform. The
  // tail of D is cut off at grazing reflections close to u = 1, so cells grow narrower there.
  const dvec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
  const auto lambda = [&](const dvec3& w) {
    const double t2 = (1 - w.z * w.z) / (w.z * w.z);
    return (std::sqrt(1 + alpha * alpha * t2) - 1) / 2;
  };
  const int rings = 1500, sectors = 600;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double left = 1 - (i + 0.5) / rings;
    const double beyond = left * left * left * left;  // 1 - u
    const double t = alpha * std::sqrt((1 - beyond) / beyond);
    const double z = 1 / std::sqrt(1 + t * t), r = t * z;
    double ring = 0;
    for (int j = 0; j < sectors; ++j) {
      const double phi = kPi * (j + 0.5) / sectors;  // symmetric in the plane of incidence
      const dvec3 h(r * std::cos(phi), r * std::sin(phi), z);
      const double oh = dot(wo, h);
      const dvec3 wi = 2 * oh * h - wo;
      if (oh > 0 && wi.z > 0) ring += oh / (cosine * z * (1 + lambda(wo) + lambda(wi)));
    }
    sum += ring * 4 * left * left * left;
  }
  return sum / (static_cast<double>(rings) * sectors);
}

double fuzz_share_above(double cosine, double fuzz) {
  // The ball of radius fuzz around the tip of the mirror direction, at height `cosine`, loses the
  // cap below the surface.
  if (cosine >= fuzz) return 1;
  const double height = fuzz - cosine;
  return 1 - height * height * (3 * fuzz - height) / (4 * fuzz * fuzz * fuzz);
}

double integrate(double low, double high, int n, const std::function<double(double)>& f) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += f(low + (high - low) * (i + 0.5) / n);
  return sum * (high - low) / n;
}

}  // namespace lightbench::proof
