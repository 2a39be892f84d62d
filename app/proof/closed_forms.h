#pragma once
// What the pictures should show, by formula or by smooth quadrature in double; nothing here is
// shared with the renderer.

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace lightbench::proof {

/// Where irradiance is asked for.
struct Receiver {
  glm::dvec3 position{0};
  glm::dvec3 normal{0, 1, 0};  ///< unit
};

/// Irradiance from a flat polygon of radiance 1 that faces the receiver, clipped at its horizon:
/// half the sum over edges of the angle each fills times the cosine of its plane (Lambert 1760).
double polygon_irradiance(const Receiver& receiver, std::vector<glm::dvec3> corners);

/// The same for a closed convex polyhedron: the sum over the faces (counter-clockwise from
/// outside) whose front the receiver sees.
double polyhedron_irradiance(const Receiver& receiver,
                             const std::vector<std::vector<glm::dvec3>>& faces);

/// A surface patch over the unit square, and the radiance it emits there.
struct EmittingPatch {
  std::function<glm::dvec3(glm::dvec2)> point;
  std::function<double(glm::dvec2)> radiance = [](glm::dvec2) { return 1.0; };
  bool flipped = false;  ///< front against dp/du x dp/dv instead of along it
};
/// Irradiance from the patches' fronts, nothing between, by the midpoint rule on n x n cells. Exact
/// visibility for the outside of convex bodies.
double patch_irradiance(const Receiver& receiver, const std::vector<EmittingPatch>& patches,
                        int n = 1000);

/// Share of the unit disc to the right of the chord x = s.
double disc_share_beyond(double s);

/// Unpolarised reflectance of a smooth border; eta = index beyond over index here.
double fresnel(double cosine, double eta);

/// Hemispherical reflectance, for light from all around, of a GGX surface with Smith's
/// height-correlated masking and microfacets that reflect fully, seen at cosine `cosine`.
double ggx_albedo(double cosine, double alpha);

/// Share of the books' fuzzy reflections that stay above the surface.
double fuzz_share_above(double cosine, double fuzz);

/// Midpoint rule over [low, high].
double integrate(double low, double high, int n, const std::function<double(double)>& f);

}  // namespace lightbench::proof
