#include "core/compile/light_candidates.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/compile/columns.h"
#include "core/compile/lenses.h"
#include "core/compile/plane_faces.h"

namespace lightbench {
namespace {

using glm::dot;
using glm::dvec3;

template <class T>
void append_candidate(const Lamp& lamp, std::uint32_t light, const PlaneFace* face, int via,
                      std::vector<T>& rows) {
  const LightPlacement& p = lamp.place;
  dvec3 center = p.center, normal = p.normal, window(0), extent(0);
  double weight = lamp.weight;
  if (face != nullptr) {
    const dvec3 w[3] = {face->dual_u(), face->dual_v(), face->n};
    for (int k = 0; k < 3; ++k) {
      window[k] = dot(w[k], p.center - face->origin);
      extent[k] = p.extent(w[k]);
    }
    if (face->thickness > 0) {
      const double nearer = face->thickness * (1 - 1 / face->ior);
      center += nearer * face->n;
      window.z = -window.z - nearer;
    } else {
      center -= 2 * window.z * face->n;
      normal -= 2 * dot(face->n, normal) * face->n;
    }
    // Of a light that the face's plane cuts, the part that is seen in it.
    window.z = std::max(window.z, 0.25 * extent.z);
    weight *= luminance(face->color);
  }
  const double radius = p.radius();
  const float shines = p.normal == dvec3(0) ? kSolid : lamp.two_sided ? kTwoSided : kOneSided;
  const double numbers[kLightCandidateStride] = {
      center.x,     center.y,       center.z,
      normal.x,     normal.y,       normal.z,
      radius,       weight,         double(light),
      double(via),  double(shines), window.x,
      window.y,     window.z,       extent.x,
      extent.y,     extent.z,       face != nullptr ? 1 / window.z : 0.0,
      0.25 / radius};
  for (const double x : numbers) rows.push_back(static_cast<T>(x));
}

/// Seen through a lens: the table in place of a window.
template <class T>
void append_candidate(const Lamp& lamp, std::uint32_t light, const GlassSphere& sphere, int lens,
                      std::vector<T>& rows) {
  append_candidate(lamp, light, nullptr, lens, rows);
  T* row = &rows[rows.size() - kLightCandidateStride];
  row[10] = static_cast<T>(1 / glm::distance(lamp.place.center, sphere.middle()));
  const auto turns = lens_turns(lamp, sphere);
  std::transform(turns.begin(), turns.end(), row + 11, [](double x) { return static_cast<T>(x); });
}

}  // namespace

template <class T>
void add_light_candidates(const Scene& scene, const GeometryPart<T>& geometry,
                          const std::vector<Lamp>& lamps, LightPart<T>& lights) {
  const std::size_t count = lamps.size();
  if (count == 0) return;
  const auto light_index = [](std::size_t l) { return static_cast<std::uint32_t>(l); };
  for (std::size_t l = 0; l < count; ++l) {
    append_candidate(lamps[l], light_index(l), nullptr, -1, lights.candidates);
  }
  lights.direct_candidates = light_index(count);

  std::uint32_t candidates = lights.direct_candidates;
  // Candidates for the lamps that `can_light`, by one way more; false where there are none, or more
  // than the table has room for.
  const auto add_images = [&](auto can_light, auto append) {
    std::vector<std::uint32_t> of_lights(count, kNoLight);
    std::uint32_t end = candidates;
    for (std::size_t l = 0; l < count; ++l) {
      if (lamps[l].weight > 0 && can_light(l)) of_lights[l] = end++;
    }
    if (end == candidates || end > kMaxWithImages) return false;
    for (std::size_t l = 0; l < count; ++l) {
      if (of_lights[l] != kNoLight) append(l);
    }
    candidates = end;
    lights.image_candidate.insert(lights.image_candidate.end(), of_lights.begin(), of_lights.end());
    return true;
  };
  // Beyond glass lights are met by rays of their own, which meet no meshes.
  const auto is_mesh = [&](std::size_t l) {
    return static_cast<PrimitiveKind>(geometry.kind[lights.primitive[l]]) == PrimitiveKind::Mesh;
  };
  const auto add_face = [&](const PlaneFace& face) {
    const auto number = static_cast<int>(lights.face_end.size());
    const bool added = add_images(
        [&](std::size_t l) {
          return lights.primitive[l] != face.primitive && !(face.thickness > 0 && is_mesh(l)) &&
                 can_light(lamps[l], face);
        },
        [&](std::size_t l) {
          append_candidate(lamps[l], light_index(l), &face, number, lights.candidates);
        });
    if (!added) return;
    lights.face_end.push_back(candidates);
    append_face(face, geometry.offset[face.primitive], lights.faces);
  };
  for (const PlaneFace& face : mirror_faces(scene, geometry)) add_face(face);
  lights.mirror_count = static_cast<std::uint32_t>(lights.face_end.size());
  const ObjectBoxes boxes(scene);
  for (const PlaneFace& face : pane_faces(scene, geometry, boxes)) add_face(face);
  append_columns(lights.faces.data(), lights.face_end.size(), kFaceStride, lights.face_columns);
  lights.first_lens_candidate = candidates;
  for (const GlassSphere& sphere : glass_spheres(scene, geometry, boxes)) {
    const auto lens = static_cast<int>(lights.face_end.size() + lights.lens_end.size());
    const bool added =
        add_images([&](std::size_t l) { return !is_mesh(l) && can_light(lamps[l], sphere); },
                   [&](std::size_t l) {
                     append_candidate(lamps[l], light_index(l), sphere, lens, lights.candidates);
                     for (const double x : lens_table(lamps[l], sphere)) {
                       lights.lens_tables.push_back(static_cast<T>(x));
                     }
                   });
    if (!added) continue;
    lights.lens_end.push_back(candidates);
    append_lens(sphere, geometry.offset[sphere.primitive], lights.lenses);
  }
  if (count == 1 && lights.face_end.empty() && lights.lens_end.empty()) {
    lights.candidates.clear();
    lights.direct_candidates = 0;
  }
}

template void add_light_candidates(const Scene&, const GeometryPart<float>&,
                                   const std::vector<Lamp>&, LightPart<float>&);
template void add_light_candidates(const Scene&, const GeometryPart<double>&,
                                   const std::vector<Lamp>&, LightPart<double>&);

}  // namespace lightbench
