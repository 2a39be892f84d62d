#include "core/compile/surface_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <variant>
#include <vector>

#include "core/compile/mesh_copies.h"
#include "core/scene/bounds.h"
#include "core/scene/transform.h"

namespace lightbench {
namespace {

using glm::dot;
using glm::dvec3;

/// A sphere when the shutter opens, and its motion until it closes; or the side of a cylinder: its
/// axis from `center` along `along`.
struct Round {
  std::size_t object;
  dvec3 center, along;
  double radius;
  bool cylinder;
  double place = 0;  ///< along kAside
};

/// A flat face. `height` is that of its plane over the scene's center.
struct Face {
  std::size_t object;
  std::array<dvec3, 4> corners;
  dvec3 n;
  double height;
  Bounds bounds;
};

struct Surfaces {
  std::vector<Round> rounds;
  std::vector<Face> faces;
  dvec3 center{0};

  void add_face(std::size_t object, const std::array<dvec3, 4>& corners) {
    const dvec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (!(length(across) > 0)) return;
    Face f{object, corners, normalize(across), 0, {}};
    // One sign for both sides of a plane.
    if (dot(f.n, kAside) < 0) f.n = -f.n;
    f.height = dot(f.n, corners[0] - center);
    for (const dvec3& c : corners) f.bounds.add(c);
    faces.push_back(f);
  }
};

/// Adds the surfaces of an object; those that a transform makes uneven are left out.
struct Collect {
  Surfaces& surfaces;
  std::size_t object;
  glm::dmat4 map;
  double scale;  ///< 0 if it is not the same in all directions
  const Scene& scene;
  bool few_triangles;

  [[nodiscard]] dvec3 point(const dvec3& p) const { return dvec3(map * glm::dvec4(p, 1)); }
  [[nodiscard]] dvec3 vector(const dvec3& v) const { return dvec3(map * glm::dvec4(v, 0)); }
  void parallelogram(const dvec3& corner, const dvec3& u, const dvec3& v) const {
    surfaces.add_face(object,
                      {point(corner), point(corner + u), point(corner + v), point(corner + u + v)});
  }
  void triangle(const dvec3& a, const dvec3& b, const dvec3& c) const {
    surfaces.add_face(object, {point(a), point(b), point(c), point(c)});
  }
  void disc(const dvec3& middle, const dvec3& normal, double radius) const {
    const dvec3 n = glm::normalize(normal);
    const dvec3 other = std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = radius * glm::normalize(cross(n, other)), v = cross(n, u);
    parallelogram(middle - u - v, 2.0 * u, 2.0 * v);
  }

  void operator()(const SphereShape& s) const {
    if (scale == 0) return;
    const dvec3 opened = s.center + scene.camera.shutter_open * s.motion;
    const dvec3 motion = (scene.camera.shutter_close - scene.camera.shutter_open) * s.motion;
    surfaces.rounds.push_back({object, point(opened), vector(motion), scale * s.radius, false});
  }
  void operator()(const CylinderShape& s) const {
    disc(s.p0, s.p1 - s.p0, s.radius);
    disc(s.p1, s.p1 - s.p0, s.radius);
    if (scale == 0) return;
    surfaces.rounds.push_back({object, point(s.p0), vector(s.p1 - s.p0), scale * s.radius, true});
  }
  void operator()(const DiscShape& s) const { disc(s.center, s.normal, s.radius); }
  void operator()(const RectangleShape& s) const { parallelogram(s.corner, s.edge_u, s.edge_v); }
  void operator()(const TriangleShape& s) const { triangle(s.a, s.b, s.c); }
  void operator()(const PyramidShape& s) const {
    for (std::size_t i = 0; i < 4; ++i) {
      triangle(s.vertices[(i + 1) % 4], s.vertices[(i + 2) % 4], s.vertices[(i + 3) % 4]);
    }
  }
  void operator()(const BoxShape& s) const {
    const dvec3 x(s.max.x - s.min.x, 0, 0), y(0, s.max.y - s.min.y, 0), z(0, 0, s.max.z - s.min.z);
    for (const dvec3& corner : {s.min, s.min + x}) parallelogram(corner, y, z);
    for (const dvec3& corner : {s.min, s.min + y}) parallelogram(corner, z, x);
    for (const dvec3& corner : {s.min, s.min + z}) parallelogram(corner, x, y);
  }
  void operator()(const MeshShape& s) const {
    if (!few_triangles) return;
    const auto& mesh = scene.meshes[static_cast<std::size_t>(s.mesh)].data;
    if (mesh == nullptr) return;
    for (const auto& t : mesh->triangles) {
      triangle(mesh->positions[t[0]], mesh->positions[t[1]], mesh->positions[t[2]]);
    }
  }
};

bool has_few_triangles(const Scene& scene, std::span<const std::uint8_t> roles) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const auto* s = std::get_if<MeshShape>(&scene.objects[i].shape);
    if (roles[i] == 0 || s == nullptr) continue;
    const auto& mesh = scene.meshes[static_cast<std::size_t>(s->mesh)].data;
    count += mesh == nullptr ? 0 : mesh->triangles.size();
  }
  return count <= kFewTriangles;
}

Surfaces collect(const Scene& scene, std::span<const std::uint8_t> roles, const dvec3& center) {
  Surfaces surfaces;
  surfaces.center = center;
  const bool few_triangles = has_few_triangles(scene, roles);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (roles[i] == 0) continue;
    const dvec3 s = glm::abs(object.transform.scale);
    const double scale = s.x == s.y && s.y == s.z ? s.x : 0;
    std::visit(Collect{surfaces, i, object_to_world(object.transform), scale, scene, few_triangles},
               object.shape);
  }
  return surfaces;
}

/// Cosine above which faces count as parallel; how far they are from it their corners tell.
constexpr double kParallel = 0.99;

/// Farthest that b is from a anywhere; both of one kind.
double gap_of(const Round& a, const Round& b) {
  const double radii = std::abs(a.radius - b.radius);
  if (!a.cylinder) {
    return radii +
           std::max(distance(a.center, b.center), distance(a.center + a.along, b.center + b.along));
  }
  const dvec3 axis = glm::normalize(a.along);
  const auto off_axis = [&](const dvec3& p) { return glm::length(cross(p - a.center, axis)); };
  const double from = dot(b.center - a.center, axis), to = from + dot(b.along, axis);
  const bool overlap = std::max(from, to) > 0 && std::min(from, to) < glm::length(a.along);
  return overlap ? radii + std::max(off_axis(b.center), off_axis(b.center + b.along))
                 : std::numeric_limits<double>::infinity();
}

/// Of faces whose boxes overlap in two axes at least by more than that.
double gap_of(const Face& a, const Face& b, double limit) {
  const dvec3 overlap = glm::min(a.bounds.max, b.bounds.max) - glm::max(a.bounds.min, b.bounds.min);
  if (std::min({overlap.x, overlap.y, overlap.z}) < -limit) {
    return std::numeric_limits<double>::infinity();
  }
  const auto farthest_corner = [](const Face& plane, const Face& face) {
    double far = 0;
    for (const dvec3& c : face.corners) {
      far = std::max(far, std::abs(dot(plane.n, c - plane.corners[0])));
    }
    return far;
  };
  const double gap = std::min(farthest_corner(a, b), farthest_corner(b, a));
  const int wide =
      (overlap.x > gap ? 1 : 0) + (overlap.y > gap ? 1 : 0) + (overlap.z > gap ? 1 : 0);
  return wide < 2 ? std::numeric_limits<double>::infinity() : gap;
}

}  // namespace

SurfaceGap smallest_gap(const Scene& scene, std::span<const std::uint8_t> roles,
                        const dvec3& center, double contact, double limit) {
  Surfaces surfaces = collect(scene, roles, center);
  SurfaceGap found;
  found.gap = limit;
  const auto keep = [&](double gap, std::size_t a, std::size_t b) {
    if (a != b && gap > contact && gap < found.gap) found = {gap, a, b};
  };
  auto& [rounds, faces, unused] = surfaces;
  // Close surfaces are neighbours along a line; few others are. Of a cylinder counts the point of
  // its axis that is nearest to the scene's center.
  const auto place = [&](const Round& r) {
    const dvec3 from = r.center - center;
    const dvec3 foot =
        r.cylinder ? from - r.along * (dot(from, r.along) / dot(r.along, r.along)) : from;
    return dot(foot, kAside);
  };
  for (Round& r : rounds) r.place = place(r);
  std::sort(rounds.begin(), rounds.end(), [](const Round& a, const Round& b) {
    return std::pair(a.cylinder, a.place) < std::pair(b.cylinder, b.place);
  });
  const double reach = length(kAside);
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    for (std::size_t k = i + 1; k < rounds.size() && rounds[k].cylinder == rounds[i].cylinder &&
                                rounds[k].place - rounds[i].place < reach * found.gap;
         ++k) {
      keep(gap_of(rounds[i], rounds[k]), rounds[i].object, rounds[k].object);
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.height < b.height; });
  for (std::size_t i = 0; i < faces.size(); ++i) {
    // Planes at the same height touch or are not parallel.
    const auto apart = std::upper_bound(
        faces.begin() + static_cast<std::ptrdiff_t>(i), faces.end(), faces[i].height + contact,
        [](double height, const Face& f) { return height < f.height; });
    for (auto k = apart; k != faces.end() && k->height - faces[i].height < found.gap; ++k) {
      if (std::abs(dot(faces[i].n, k->n)) < kParallel) continue;
      keep(gap_of(faces[i], *k, found.gap), faces[i].object, k->object);
    }
  }
  const SurfaceGap copies = smallest_copy_gap(scene, roles, center, contact, found.gap);
  if (copies.gap < found.gap) return copies;
  return found.gap < limit ? found : SurfaceGap();
}

}  // namespace lightbench
