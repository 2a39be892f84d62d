#pragma once
// The editable scene: plain values with defaults, indices for references (kNone = none).
// The UI edits a Scene, files store one, undo is a list of them. Rendering never reads it:
// compile() turns it into an immutable RenderScene. Copying is cheap because meshes and images are
// shared.
//
// Conventions: right-handed, y up unless the camera says otherwise; angles in degrees; lengths in
// scene units (1 unit = 1 m when a physical camera is described); colours linear Rec. 709.
//
// To add a shape: a struct here and in `Shape`, a file in core/shapes, a case in core/compile,
// a reader and writer in core/scene/json_*.cpp, its fields in ui/shape_fields.cpp.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/mesh.h"
#include "core/scene/texels.h"

namespace lightbench {

inline constexpr int kNone = -1;

// ---- shapes, in object space
// ---------------------------------------------------------------------

/// Centre at time t (shutter units, 0..1) is center + t * motion.
struct SphereShape {
  glm::dvec3 center{0};
  double radius = 1;
  glm::dvec3 motion{0};
  bool operator==(const SphereShape&) const = default;
};

/// Capped cylinder between the centres of its two caps.
struct CylinderShape {
  glm::dvec3 p0{0, 0, 0};
  glm::dvec3 p1{0, 1, 0};
  double radius = 0.5;
  bool operator==(const CylinderShape&) const = default;
};

/// `normal` need not be unit; it points to the front.
struct DiscShape {
  glm::dvec3 center{0};
  glm::dvec3 normal{0, 1, 0};
  double radius = 1;
  bool operator==(const DiscShape&) const = default;
};

/// Parallelogram corner + u edge_u + v edge_v, u and v in [0,1]; front is edge_u x edge_v.
struct RectangleShape {
  glm::dvec3 corner{0};
  glm::dvec3 edge_u{1, 0, 0};
  glm::dvec3 edge_v{0, 1, 0};
  bool operator==(const RectangleShape&) const = default;
};

/// Front is (b - a) x (c - a).
struct TriangleShape {
  glm::dvec3 a{0, 0, 0};
  glm::dvec3 b{1, 0, 0};
  glm::dvec3 c{0, 1, 0};
  bool operator==(const TriangleShape&) const = default;
};

/// Solid tetrahedron ("triangular pyramid"); the order of the vertices does not matter.
struct PyramidShape {
  std::array<glm::dvec3, 4> vertices{glm::dvec3{0, 1, 0}, glm::dvec3{-1, 0, -1},
                                     glm::dvec3{1, 0, -1}, glm::dvec3{0, 0, 1}};
  bool operator==(const PyramidShape&) const = default;
};

struct BoxShape {
  glm::dvec3 min{-0.5};
  glm::dvec3 max{0.5};
  bool operator==(const BoxShape&) const = default;
};

/// Index into Scene::meshes.
struct MeshShape {
  int mesh = kNone;
  bool operator==(const MeshShape&) const = default;
};

using Shape = std::variant<SphereShape, CylinderShape, DiscShape, RectangleShape, TriangleShape,
                           PyramidShape, BoxShape, MeshShape>;

/// A mesh is inline (`file` empty) or loaded from `file`. All file names here are as the process
/// would open them (absolute once loaded); scene files hold them relative to themselves.
struct MeshAsset {
  std::string name;
  std::string file;
  std::shared_ptr<const Mesh> data;
  bool operator==(const MeshAsset&) const = default;  // payload compared by pointer: cheap, exact
};

// ---- appearance
// ----------------------------------------------------------------------------------

enum class TextureKind { Constant, Image, Checker, Noise, Turbulence, Marble };
enum class WrapMode { Repeat, Clamp, Mirror };

/// Fields that a kind does not use keep their values, so that switching kinds loses nothing.
struct Texture {
  std::string name;
  TextureKind kind = TextureKind::Constant;
  glm::dvec3 color_a{0.9};  ///< constant; checker even; noise low
  glm::dvec3 color_b{0.1};  ///< checker odd; noise, turbulence and marble high
  double scale = 1;         ///< checker: cells per unit (3-D) or per uv; noise: frequency
  bool use_uv = false;      ///< checker: in uv instead of object space
  int octaves = 7;          ///< turbulence and marble, 1..16
  std::uint32_t seed = 0;   ///< noise lattice
  WrapMode wrap = WrapMode::Repeat;
  std::string file;  ///< image
  bool srgb = true;  ///< image: 8-bit values are sRGB encoded and decoded to linear
  std::shared_ptr<const Texels> image;
  bool operator==(const Texture&) const = default;
};

enum class MaterialKind { Lambertian, Metal, Dielectric, Emissive };

/// glTF's names where glTF has one. Any kind may emit; Emissive reflects nothing.
struct Material {
  std::string name;
  MaterialKind kind = MaterialKind::Lambertian;
  glm::dvec3 base_color{0.8};      ///< albedo, specular reflectance or transmission tint, [0,1]
  int base_color_texture = kNone;  ///< multiplies base_color
  double fuzz = 0;                 ///< metal: the books' fuzz, [0,1]; exclusive with roughness
  double roughness = 0;            ///< metal: glTF roughness, GGX alpha = roughness^2, [0,1]
  double ior = 1.5;                ///< dielectric, inside over outside, > 0
  glm::dvec3 emissive{0};          ///< emitted radiance = emissive * emissive_strength * texture
  double emissive_strength = 1;
  int emissive_texture = kNone;
  bool two_sided = false;  ///< emits from its back too
  bool operator==(const Material&) const = default;
};

/// Homogeneous participating medium with an isotropic phase function.
struct Medium {
  std::string name;
  double density = 1;    ///< extinction, 1 / scene unit, > 0
  glm::dvec3 albedo{1};  ///< single-scattering albedo, [0,1]
  bool operator==(const Medium&) const = default;
};

// ---- objects
// -------------------------------------------------------------------------------------

/// Object to world: scale, then rotate about `axis` through the object's origin, then translate.
struct Transform {
  glm::dvec3 translation{0};
  glm::dvec3 axis{0, 1, 0};  ///< need not be unit, not zero
  double degrees = 0;        ///< right-handed
  glm::dvec3 scale{1};       ///< no component zero
  bool operator==(const Transform&) const = default;
};

/// A surface (material), a medium's boundary (medium), or both (murky glass). With no material the
/// boundary is invisible. A medium needs a closed shape: sphere, cylinder, pyramid, box, mesh.
struct Object {
  std::string name;
  Shape shape;
  Transform transform;
  int material = kNone;
  int medium = kNone;
  bool visible = true;
  bool operator==(const Object&) const = default;
};

// ---- camera, environment, settings
// ---------------------------------------------------------------

struct Camera {
  glm::dvec3 look_from{0, 1, 5};
  glm::dvec3 look_at{0};
  glm::dvec3 up{0, 1, 0};
  double vfov = 40;            ///< degrees, (0, 180)
  double sensor_height = 24;   ///< mm; with vfov it gives the focal length
  double lens_radius = 0;      ///< scene units; 0 = pinhole
  double focus_distance = 10;  ///< scene units along the view axis, > 0
  double shutter_open = 0;     ///< times at which `motion` is evaluated, open <= close
  double shutter_close = 1;
  bool operator==(const Camera&) const = default;
};

/// Focal length in mm of `camera`, and the vfov in degrees that a focal length gives.
double focal_length(const Camera& camera);
double vfov_from_focal_length(double millimetres, double sensor_height);
/// f-number of the lens, with 1 unit = 1 m; infinity for a pinhole. And back.
double f_stop(const Camera& camera);
double lens_radius_from_f_stop(double f_stop, double focal_length_mm);

enum class EnvironmentKind { Constant, Gradient, Image };

/// Radiance that arrives from outside the scene.
struct Environment {
  EnvironmentKind kind = EnvironmentKind::Constant;
  glm::dvec3 color{0};    ///< constant; gradient at the zenith; multiplies the image
  glm::dvec3 horizon{1};  ///< gradient at the nadir: the books' lerp over y in [-1,1]
  double strength = 1;
  double rotation = 0;  ///< degrees about +y, image only
  std::string file;     ///< equirectangular image
  std::shared_ptr<const Texels> image;
  bool operator==(const Environment&) const = default;
};

enum class FilterKind { Box, Triangle, Gaussian };

/// Pixel window; width 0 = the whole picture.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Crop&) const = default;
};

/// How paths find what surfaces emit; all three have the same mean (Veach 1997, ch. 9).
enum class Strategy {
  Mis,     ///< light and BSDF sampling, weighted against each other
  Lights,  ///< light sampling; paths' own rays count emission only where that cannot reach it
  Bsdf,    ///< paths' own rays only
};

/// Which light a point samples (core/lights/light_choice.h); all have the same mean.
enum class LightChoiceBy {
  Images,        ///< by contribution, images in plane mirrors and glass included
  Contribution,  ///< by what each light would bring to the point
  Power,         ///< by emitted power, the same everywhere
};

/// Where the numbers of a sample come from.
enum class SamplerKind {
  Sobol,        ///< Owen-scrambled Sobol points
  Independent,  ///< hashes: plain Monte Carlo, to measure the other against
};

struct RenderSettings {
  int width = 600;
  int height = 600;
  Crop crop;
  int spp = 1000;          ///< target; 0 = no limit
  double time_limit = 0;   ///< seconds; 0 = no limit
  int max_depth = 50;      ///< path segments from the camera, >= 1
  int roulette_depth = 4;  ///< bounces before Russian roulette starts
  Strategy strategy = Strategy::Mis;
  LightChoiceBy light_choice = LightChoiceBy::Images;
  SamplerKind sampler = SamplerKind::Sobol;
  std::uint32_t seed = 0;
  FilterKind filter = FilterKind::Box;
  double filter_radius = 0.5;  ///< pixels; half the width
  bool adaptive = false;       ///< more samples where there is more noise; `spp` is the average
  std::vector<int> snapshots{10, 200, 1000};
  bool operator==(const RenderSettings&) const = default;
};

enum class ToneMap { Srgb, Reinhard, Aces };

/// How linear radiance becomes display values; never restarts a render.
struct Display {
  double exposure = 0;               ///< stops
  ToneMap tone_map = ToneMap::Srgb;  ///< Srgb = clip, then the sRGB curve
  bool operator==(const Display&) const = default;
};

struct Scene {
  Camera camera;
  RenderSettings render;
  Display display;
  Environment environment;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Medium> media;
  std::vector<MeshAsset> meshes;
  std::vector<Object> objects;
  bool operator==(const Scene&) const = default;
};

/// True if objects with this material are light sources.
bool emits(const Material& material);

}  // namespace lightbench
