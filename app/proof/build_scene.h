#pragma once
// Short words for building scenes whose pictures are known.

#include <vector>

#include "core/scene/scene.h"

namespace lightbench::proof {

/// A black scene with a small square picture.
Scene dark_scene(int size = 32);
/// The same within an environment of one radiance from everywhere.
Scene furnace_scene(double radiance = 1, int size = 32);

/// A black scene before a square wall behind z = -3, `width` wide, that emits 1 towards +z.
Scene wall_scene(double width, int size = 32);

/// The whole picture looks along one ray, from `from` to `at`: it shows one point.
void aim(Scene& scene, const glm::dvec3& from, const glm::dvec3& at);
/// An ordinary view.
void look(Scene& scene, const glm::dvec3& from, const glm::dvec3& at, double vfov);

Material lambertian(const glm::dvec3& albedo);
Material mirror(const glm::dvec3& reflectance);
Material fuzzy_metal(const glm::dvec3& reflectance, double fuzz);
Material rough_metal(const glm::dvec3& reflectance, double roughness);
Material glass(double ior);
/// Reflects nothing.
Material light(const glm::dvec3& radiance, bool two_sided = false);
/// Reflects nothing, emits nothing.
Material black();

int add_texture(Scene& scene, const Texture& texture);
int add_mesh(Scene& scene, const Mesh& mesh);
void add(Scene& scene, const Shape& shape, const Material& material,
         const Transform& transform = {});
void add_medium(Scene& scene, const Shape& shape, double density, const glm::dvec3& albedo,
                const Transform& transform = {});

Transform moved(const glm::dvec3& translation);
Transform scaled(const glm::dvec3& scale, const glm::dvec3& translation = glm::dvec3(0));
Transform turned(const glm::dvec3& axis, double degrees,
                 const glm::dvec3& translation = glm::dvec3(0));

/// A shape with a name and where it stands.
struct PlacedShape {
  const char* name;
  Shape shape;
  Transform transform;
};
/// A closed convex mesh: the octahedron with corners at distance `radius` from the origin.
Mesh octahedron(double radius = 1);
/// Every closed convex shape, about 2 wide and around the origin; meshes are added to `scene`.
std::vector<PlacedShape> closed_shapes(Scene& scene);

}  // namespace lightbench::proof
