#pragma once
// The arrays behind a RenderScene. Each part is immutable and shared by every later RenderScene
// whose edit did not touch it.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <variant>
#include <vector>

#include "core/accel/bvh.h"
#include "core/compile/render_scene.h"
#include "core/compile/scene_reach.h"
#include "core/kernel/scene_view.h"

namespace lightbench {

/// A mesh with its BVH, in a space of its own: centred and of unit size, so that float suits it
/// wherever the mesh's coordinates lie. mesh space = (object space - center) * scale.
template <class T>
struct MeshPart {
  std::shared_ptr<const Mesh> source;
  glm::dvec3 center{0};
  double scale = 1;
  std::vector<BvhNode> nodes;
  std::vector<TriangleBlock<T>> blocks;
  std::vector<std::uint32_t> slot_triangle;  ///< triangle of the source, or Bvh::kPadding
  std::vector<std::uint32_t> triangle_slot;  ///< and back
};

/// Primitives in render space and the tree over them.
template <class T>
struct GeometryPart {
  std::shared_ptr<const SceneReach> reach;
  RenderSpace space;
  std::uint32_t surface_count = 0;
  std::uint32_t walls[kPrimitiveKinds] = {};  ///< the last of each kind (walls.h)
  bool moving = false;
  std::vector<std::uint32_t> kind, row;
  std::vector<T> rows, offset, to_object;
  std::vector<T> columns[kPrimitiveKinds];       ///< of few surfaces of a kind
  std::vector<T> offset_column;                  ///< of few primitives
  std::vector<int> object;                       ///< of each primitive, index into Scene::objects
  std::vector<std::uint32_t> surface_of_object;  ///< primitive, or kNoHit; by Scene::objects
  std::vector<double> area;  ///< render space; of a mesh instance 0 (see light part)
  std::vector<MeshView<T>> mesh_views;
  std::vector<std::shared_ptr<const MeshPart<T>>> meshes;  ///< by Scene::meshes, null if unused
  std::vector<BvhBox> boxes;                               ///< of surfaces, in tiny scenes
  Bvh tree;                                                ///< no nodes in tiny scenes
  std::vector<std::uint32_t> wide;                         ///< surfaces that the tree does without
  float built_cost = 0;  ///< expected_cost() of the tree when it was built, not fitted
};

template <class T>
struct MaterialPart {
  std::vector<T> rows, columns;
  std::vector<std::uint32_t> of_primitive, of_primitive_column;
  std::vector<MediumView<T>> media;
  double brightest = 0;  ///< largest component of the radiance that a surface emits
};

template <class T>
struct LightPart {
  std::vector<std::uint32_t> first_of_primitive, first_of_primitive_column, primitive_column;
  std::vector<std::uint32_t> primitive, slot, alias_other;
  std::vector<T> pmf, alias_threshold;
  // Choice by contribution (core/compile/light_candidates.h).
  std::uint32_t direct_candidates = 0, mirror_count = 0, first_lens_candidate = 0;
  std::vector<T> candidates, faces, face_columns, lenses, lens_tables;
  std::vector<std::uint32_t> face_end, image_candidate, lens_end;
  // By a tree (core/compile/light_tree.h).
  int tree_cluster_bits = 0;
  std::vector<T> tree_rows;
  std::vector<std::uint32_t> tree_child, tree_trail;
};

template <class T>
struct TexturePart {
  std::vector<T> rows;
  std::vector<ImageView> images;
  std::vector<std::shared_ptr<const Texels>> keep;
};

template <class T>
struct KernelParts {
  std::shared_ptr<const GeometryPart<T>> geometry;
  std::shared_ptr<const MaterialPart<T>> materials;
  std::shared_ptr<const LightPart<T>> lights;
  std::shared_ptr<const TexturePart<T>> textures;
  std::shared_ptr<const Texels> environment;
  glm::dvec3 environment_peak{0};  ///< largest value of each channel of that image
  SceneView<T> view;
};

struct RenderScene::Parts {
  std::shared_ptr<const SceneReach> reach;
  std::variant<KernelParts<float>, KernelParts<double>> kernel;
};

}  // namespace lightbench
