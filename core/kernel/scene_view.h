#pragma once
// What a kernel sees of a RenderScene: plain pointers and numbers in render space, number type T.
// The arrays belong to RenderScene::Parts, which outlives every render() call. A feature that the
// scene lacks is an empty array or a false flag here, and the kernel never enters its code.

#include <cstdint>

#include "core/accel/bvh_node.h"

namespace lightbench {

enum class PrimitiveKind : std::uint32_t {
  Sphere,
  Ellipsoid,  ///< affine image of a sphere (non-uniform scale)
  Cylinder,
  EllipticCylinder,  ///< affine image of a cylinder
  Disc,              ///< ellipse in general
  Rectangle,         ///< parallelogram in general
  Triangle,
  Pyramid,
  Box,
  Mesh,
};
inline constexpr unsigned kPrimitiveKinds = 10;

enum class BsdfKind : std::uint32_t { Black, Lambertian, Mirror, Fuzz, Ggx, Dielectric };

/// Below this many primitives (and without meshes) a loop over all of them beats a tree: with
/// sixteen lanes up to about 300 spheres or 120 cylinders, with eight 150 or 70. The same for all
/// kernels, so that their films agree.
inline constexpr std::uint32_t kTinyScene = 96;

/// Whether the closest approach of rays to round shapes is worth refining: it is where the scene's
/// range is large (core/compile/scene_reach.h).
enum class HitQuality { Plain, Refined };

inline constexpr std::uint32_t kNoLight = 0xffffffffU;
inline constexpr std::uint32_t kNoHit = 0xffffffffU;
inline constexpr unsigned kMaterialStride = 16;
/// Rows of tables that are stored by columns too.
inline constexpr unsigned kColumnRows = 16;
inline constexpr unsigned kTextureStride = 16;
/// Lights that are chosen between by contribution one by one, at most; and how many there may be
/// with their images in mirrors and glass, which cost several times as much.
inline constexpr unsigned kMaxLightCandidates = 64, kMaxWithImages = 32;
/// How candidates shine.
inline constexpr float kOneSided = 0, kTwoSided = 1, kSolid = 2;
inline constexpr unsigned kLightCandidateStride = 19;
inline constexpr unsigned kFaceStride = 21;
inline constexpr unsigned kLensStride = 14;
/// Numbers of the function that a candidate seen through a lens tabulates.
inline constexpr unsigned kLensNodes = 8;
/// Cells of the table of what such a candidate brings (core/compile/lenses.h): by R / D, and by the
/// sine of half the angle between the light and the axis.
inline constexpr unsigned kLensNearness = 16, kLensAngles = 32;
inline constexpr unsigned kLensCells = kLensNearness * kLensAngles;
inline constexpr std::uint32_t kStraight = 0xffffffffU;
inline constexpr unsigned kLightNodeStride = 11;
inline constexpr std::uint32_t kLightLeaf = 0x80000000U;
inline constexpr std::uint32_t kNoTrail = 0xffffffffU;
enum class FaceOutline : std::uint32_t { Parallelogram, Triangle, Disc };
/// Numbers in a mesh's row before the index of the mesh.
inline constexpr unsigned kMeshRow = 24;

/// What paths need of few triangles, their normals and uvs, stays where the scene's mesh has it.
template <class T>
struct MeshView {
  const BvhNode* nodes = nullptr;
  const TriangleBlock<T>* blocks = nullptr;
  const std::uint32_t* slot_triangle = nullptr;  ///< triangle of each slot (block * 8 + column)
  const std::uint32_t* triangles = nullptr;      ///< its vertices, 3 per triangle
  const double* normals = nullptr;               ///< 3 per vertex, or null
  const double* uvs = nullptr;                   ///< 2 per vertex, or null
  bool beyond_cache = false;                     ///< nodes and blocks are worth asking for ahead
};

/// Pixels as core/scene/texels.h has them: either `rgb` or both `packed` and `values`.
struct ImageView {
  const float* rgb = nullptr;
  const std::uint32_t* packed = nullptr;
  const float* values = nullptr;
  int width = 0, height = 0;
};

template <class T>
struct MediumView {
  std::uint32_t boundary;  ///< primitive index
  T sigma;                 ///< extinction per unit of render space
  T albedo[3];
};

template <class T>
struct CameraView {
  T origin[3], right[3], up[3],
      forward[3];  ///< right and up scaled to the focal plane at distance 1
  T lens_radius, focus_distance;
  bool moving;  ///< something moves: rays need a time in [0,1) over the shutter
  T filter_radius;
  std::uint32_t filter;  ///< FilterKind
  int width, height;     ///< picture
  int crop_x, crop_y;    ///< where film pixel (0, 0) lies
};

template <class T>
struct EnvironmentView {
  std::uint32_t kind;      ///< EnvironmentKind
  T color[3], horizon[3];  ///< strength included
  T cos_rotation, sin_rotation;
  ImageView image;
};

/// A number for each primitive or light; where they are few also as a column
/// (core/compile/columns.h).
template <class U>
struct Entries {
  const U* table = nullptr;
  const U* column = nullptr;
};

template <class T>
struct SceneView {
  // Primitives: [0, surface_count) are surfaces, the rest are boundaries of media.
  std::uint32_t surface_count = 0;
  const std::uint32_t* kind = nullptr;
  /// Surfaces are sorted by kind: those of kind k are [kind_begin[k], kind_begin[k + 1]).
  std::uint32_t kind_begin[kPrimitiveKinds + 1] = {};
  /// Where those of kind k end that shadow rays can meet: walls of the scene's hull come last
  /// (core/compile/walls.h). Only the loop over a tiny scene knows.
  std::uint32_t occluders_end[kPrimitiveKinds] = {};
  const std::uint32_t* row = nullptr;  ///< offset of the primitive's numbers in `rows`
  const T* rows = nullptr;
  /// By kind, surfaces only, from the first of its primitives on; null where they are too many.
  const T* columns[kPrimitiveKinds] = {};
  Entries<T> offset;  ///< bound on the error of a point on it, render space
  Entries<std::uint32_t> material;
  Entries<std::uint32_t> first_light;  ///< light of the primitive (of a mesh's slot 0)
  const T* to_object = nullptr;        ///< 12 per primitive; null unless solid textures are used
  const MeshView<T>* meshes = nullptr;
  HitQuality hit_quality = HitQuality::Refined;

  // Closest hits: a loop over all primitives, or the BVH when `nodes` is set.
  const BvhBox* boxes = nullptr;  ///< of the loop's surfaces, over the shutter
  const BvhNode* nodes = nullptr;
  const BvhMotion* motion = nullptr;      ///< null unless something moves
  const std::uint32_t* leaves = nullptr;  ///< primitive indices in leaf order
  bool beyond_cache = false;              ///< nodes are worth asking for ahead
  /// Surfaces that nearly every ray comes near: tested before the tree, which does without them.
  std::uint32_t wide_count = 0;
  const std::uint32_t* wide = nullptr;

  const T* materials = nullptr;
  const T* material_columns = nullptr;  ///< null where materials are too many
  const T* textures = nullptr;
  const ImageView* images = nullptr;  ///< by texture

  // Strategies: next-event estimation, and emission that paths' own rays meet where next-event
  // estimation can reach it. Both: weighted against each other.
  bool samples_lights = false;
  bool counts_hits_of_lights = true;
  std::uint32_t light_count = 0;
  Entries<std::uint32_t> light_primitive;
  const std::uint32_t* light_slot = nullptr;  ///< triangle slot of a mesh light
  const T* light_pmf = nullptr;
  const T* alias_threshold = nullptr;
  const std::uint32_t* alias_other = nullptr;

  // By contribution instead (core/lights/light_choice.h): none if there is one light, or many.
  // First the lights, in their order, then their images, face by face (core/lights/face.h) and lens
  // by lens.
  std::uint32_t candidate_count = 0, direct_candidates = 0;
  const T* light_candidates = nullptr;
  std::uint32_t mirror_count = 0, face_count = 0;  ///< mirrors come first, then panes
  const T* faces = nullptr;
  const T* face_columns = nullptr;          ///< null where faces are too many
  const std::uint32_t* face_end = nullptr;  ///< past the last candidate of each face
  /// Candidate of each face or lens and light (via * light_count + light), kNoLight for none.
  const std::uint32_t* image_candidate = nullptr;

  // Spheres of glass (core/lights/lens.h).
  std::uint32_t lens_count = 0;
  const T* lenses = nullptr;
  const T* lens_tables = nullptr;  ///< kLensCells for each of their candidates
  std::uint32_t first_lens_candidate = 0;
  const std::uint32_t* lens_end = nullptr;  ///< past the last candidate of each lens

  // By a tree instead, where there are many lights (core/lights/light_tree.h).
  // Level by level; points choose among the clusters of the last full level of at most
  // kMaxLightCandidates first, which are nodes light_clusters - 1 and on.
  std::uint32_t light_clusters = 0;
  int light_cluster_bits = 0;
  const T* light_nodes = nullptr;
  const std::uint32_t* light_children = nullptr;  ///< first of two, or kLightLeaf | light
  const std::uint32_t* light_trail = nullptr;     ///< number of each light's cluster, then turns

  std::uint32_t medium_count = 0;
  const MediumView<T>* media = nullptr;

  CameraView<T> camera;
  EnvironmentView<T> environment;
  int max_depth = 50;
  int roulette_depth = 4;
  std::uint32_t seed = 0;
  bool independent_samples = false;
  T inverse_film_unit = 1;

  bool has_triangles = false;  ///< single ones or meshes: their hits are refined
  bool has_mirror = false, has_fuzz = false, has_ggx = false, has_dielectric = false;
  bool has_lambertian = false;
  bool has_textures = false;  ///< base colour textures
  bool has_emission_textures = false;
  bool needs_uv = false;
  bool has_environment = false;  ///< not black
  bool has_emission = false;
};

/// For rays that may start anywhere, also outside of the scene's walls.
template <class T>
SceneView<T> with_all_occluders(SceneView<T> scene) {
  for (unsigned k = 0; k < kPrimitiveKinds; ++k) scene.occluders_end[k] = scene.kind_begin[k + 1];
  return scene;
}

}  // namespace lightbench
