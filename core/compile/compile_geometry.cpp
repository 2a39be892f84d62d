#include "core/compile/compile_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <iterator>
#include <limits>
#include <numeric>

#include "core/compile/columns.h"
#include "core/compile/compile_mesh.h"
#include "core/compile/shape_rows.h"
#include "core/compile/walls.h"
#include "core/parallel.h"
#include "core/scene/transform.h"

namespace lightbench {
namespace {

/// How far rays start off the surface they leave, in units of half the spacing of T at the
/// primitive's largest coordinate. A ray knows its own primitive, so analytic shapes need no more
/// than the last bit; a mesh's points pass two maps, and its neighbouring triangles are not known
/// to the ray.
constexpr double kShapeUlps = 1;
constexpr double kMeshUlps = 16;

Camera shutter_at(const Camera& camera, double time) {
  Camera c = camera;
  c.shutter_open = c.shutter_close = time;
  return c;
}

double largest_coordinate(const Bounds& b) {
  double m = 0;
  for (int k = 0; k < 3; ++k) m = std::max({m, std::abs(b.min[k]), std::abs(b.max[k])});
  return m;
}

Bounds render_bounds(const RenderSpace& space, const Bounds& b) {
  Bounds r;
  r.add(space.to_render(b.min));
  r.add(space.to_render(b.max));
  return r;
}

/// The primitives' rows hold rounded numbers; the boxes must contain what those describe.
BvhBox padded_box(const Bounds& b, double padding) {
  const double lo[3] = {b.min.x - padding, b.min.y - padding, b.min.z - padding};
  const double hi[3] = {b.max.x + padding, b.max.y + padding, b.max.z + padding};
  return outward_box(lo, hi);
}

struct Candidate {
  int object;
  PrimitiveKind kind;
  bool surface, wall;
};

template <class T>
void add_mesh_row(GeometryPart<T>& part, const MeshPart<T>& mesh, const glm::dmat4& to_render,
                  std::uint32_t index) {
  // Mesh space to object space and on to render space.
  glm::dmat4 unscale(1.0 / mesh.scale);
  unscale[3] = glm::dvec4(mesh.center, 1);
  const glm::dmat4 map = to_render * unscale;
  std::vector<double> row;
  append_affine(row, glm::inverse(map));
  append_affine(row, map);
  for (const double x : row) part.rows.push_back(static_cast<T>(x));
  part.rows.push_back(static_cast<T>(index));
}

/// From this many surfaces on, an edit keeps the tree's shape, if that still serves, and several
/// threads build a new one. Fewer are sorted anew in a few milliseconds.
constexpr std::size_t kManySurfaces = 8192;
/// How much dearer than when it was built a tree may get by edits.
constexpr float kRefitLoss = 1.05F;

/// Surfaces that a ray meets the box of with at least this probability, once it meets anything's,
/// are tested by all lanes at once before the tree, which does without them.
constexpr float kWideShare = 0.5F;

/// Takes the wide surfaces of `part` out of the boxes; returns the surfaces that the rest are of.
template <class T>
std::vector<std::uint32_t> split_wide(std::vector<BvhBox>& boxes, std::vector<BvhBox>& boxes_end,
                                      GeometryPart<T>& part) {
  BvhBox whole = boxes[0];
  for (const BvhBox& box : boxes) grow(whole, box);
  const float least = kWideShare * half_area(whole);
  std::vector<std::uint32_t> rest;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const bool mesh = static_cast<PrimitiveKind>(part.kind[i]) == PrimitiveKind::Mesh;
    if (!mesh && half_area(boxes[i]) >= least) {
      part.wide.push_back(i);
      continue;
    }
    boxes[rest.size()] = boxes[i];
    if (!boxes_end.empty()) boxes_end[rest.size()] = boxes_end[i];
    rest.push_back(i);
  }
  boxes.resize(rest.size());
  if (!boxes_end.empty()) boxes_end.resize(rest.size());
  return rest;
}

/// The tree over the surfaces of `part`: the previous one fitted to them, or a new one.
template <class T>
void find_tree(const GeometryPart<T>* previous, std::vector<BvhBox>& boxes,
               std::vector<BvhBox>& boxes_end, GeometryPart<T>& part) {
  const bool many = boxes.size() >= kManySurfaces;
  if (many && previous != nullptr && previous->tree.items.size() == boxes.size()) {
    part.tree = previous->tree;
    part.built_cost = previous->built_cost;
    refit_bvh(part.tree, boxes, boxes_end, BvhLeaf::Items);
    if (expected_cost(part.tree, BvhLeaf::Items) <= kRefitLoss * part.built_cost) return;
  }
  if (!many) {
    const std::vector<std::uint32_t> rest = split_wide(boxes, boxes_end, part);
    part.tree = build_bvh(boxes, boxes_end, BvhLeaf::Items);
    for (std::uint32_t& item : part.tree.items) item = rest[item];
    return;
  }
  Team team(0);
  part.tree = build_bvh(boxes, boxes_end, BvhLeaf::Items, team);
  part.built_cost = expected_cost(part.tree, BvhLeaf::Items);
}

}  // namespace

template <class T>
std::shared_ptr<const GeometryPart<T>> compile_geometry(const Scene& scene,
                                                        std::shared_ptr<const SceneReach> reach,
                                                        const GeometryPart<T>* previous) {
  auto part = std::make_shared<GeometryPart<T>>();
  const std::vector<std::uint8_t>& roles = reach->roles;
  const RenderSpace space{reach->center, unit_scale<T>(reach->farthest)};
  part->reach = reach;
  part->space = space;
  const std::vector<Bounds> meshes = all_mesh_bounds(scene);
  std::vector<bool> mesh_used(scene.meshes.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const auto* m = std::get_if<MeshShape>(&scene.objects[i].shape);
    if (roles[i] != 0 && m != nullptr) mesh_used[static_cast<std::size_t>(m->mesh)] = true;
  }

  part->meshes.resize(scene.meshes.size());
  part->mesh_views.resize(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (!mesh_used[i]) continue;
    if (previous != nullptr) {
      for (const auto& old : previous->meshes) {
        if (old != nullptr && old->source == scene.meshes[i].data) part->meshes[i] = old;
      }
    }
    if (part->meshes[i] == nullptr) part->meshes[i] = compile_mesh<T>(scene.meshes[i].data);
    const MeshPart<T>& m = *part->meshes[i];
    part->mesh_views[i] = mesh_view(m);
  }

  std::vector<bool> walls(scene.objects.size());
  if (scene.objects.size() < kTinyScene) walls = find_walls(scene, roles, meshes);
  // Surfaces first, then boundaries; within each by kind, so that the loop over a tiny scene
  // branches predictably; and walls last, where shadow rays stop.
  std::vector<Candidate> candidates;
  std::vector<ShapeRow> shape_rows(scene.objects.size());
  std::vector<glm::dmat4> to_render(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (roles[i] == 0) continue;
    const Object& o = scene.objects[i];
    to_render[i] = to_render_space(space, object_to_world(o.transform));
    shape_rows[i] =
        make_shape_row(o.shape, to_render[i], reach->shutter_open, reach->shutter_close);
    if (std::holds_alternative<MeshShape>(o.shape)) shape_rows[i].kind = PrimitiveKind::Mesh;
    for (const bool surface : {true, false}) {
      if ((roles[i] & (surface ? 1 : 2)) != 0) {
        candidates.push_back({static_cast<int>(i), shape_rows[i].kind, surface, walls[i]});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     if (a.surface != b.surface) return a.surface;
                     return a.kind != b.kind ? a.kind < b.kind : a.wall < b.wall;
                   });

  const double eps = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
  part->surface_of_object.assign(scene.objects.size(), kNoHit);
  std::vector<BvhBox> boxes, boxes_end;
  bool has_mesh = false;
  for (const Candidate& c : candidates) {
    const auto i = static_cast<std::size_t>(c.object);
    const Object& o = scene.objects[i];
    part->kind.push_back(static_cast<std::uint32_t>(c.kind));
    part->row.push_back(static_cast<std::uint32_t>(part->rows.size()));
    part->object.push_back(c.object);
    part->area.push_back(shape_rows[i].area);
    if (const auto* m = std::get_if<MeshShape>(&o.shape)) {
      const auto index = static_cast<std::uint32_t>(m->mesh);
      add_mesh_row(*part, *part->meshes[index], to_render[i], index);
    } else {
      for (const double x : shape_rows[i].numbers) part->rows.push_back(static_cast<T>(x));
    }
    std::vector<double> inverse;
    append_affine(inverse, glm::inverse(to_render[i]));
    for (const double x : inverse) part->to_object.push_back(static_cast<T>(x));

    const Bounds box = render_bounds(space, object_bounds(o, scene.camera, meshes));
    const double ulp = eps * largest_coordinate(box);
    part->offset.push_back(
        static_cast<T>(ulp * (c.kind == PrimitiveKind::Mesh ? kMeshUlps : kShapeUlps)));
    if (!c.surface) continue;
    part->surface_of_object[i] = part->surface_count++;
    if (c.wall) ++part->walls[static_cast<std::size_t>(c.kind)];
    has_mesh = has_mesh || c.kind == PrimitiveKind::Mesh;
    const auto* sphere = std::get_if<SphereShape>(&o.shape);
    const bool moves = sphere != nullptr && sphere->motion != glm::dvec3(0) &&
                       reach->shutter_close > reach->shutter_open;
    part->moving = part->moving || moves;
    const auto at = [&](double time) {
      return padded_box(
          render_bounds(space, object_bounds(o, shutter_at(scene.camera, time), meshes)), 4 * ulp);
    };
    boxes.push_back(moves ? at(reach->shutter_open) : padded_box(box, 4 * ulp));
    boxes_end.push_back(moves ? at(reach->shutter_close) : boxes.back());
  }
  for (std::size_t begin = 0, end = 0; begin < part->surface_count; begin = end) {
    while (end < part->surface_count && part->kind[end] == part->kind[begin]) ++end;
    const std::size_t next = end < part->row.size() ? part->row[end] : part->rows.size();
    append_columns(&part->rows[part->row[begin]], end - begin,
                   (next - part->row[begin]) / (end - begin), part->columns[part->kind[begin]]);
  }
  append_columns(part->offset.data(), part->offset.size(), 1, part->offset_column);
  if (part->surface_count >= kTinyScene || has_mesh) {
    if (!part->moving) boxes_end.clear();
    find_tree(previous, boxes, boxes_end, *part);
    std::fill(std::begin(part->walls), std::end(part->walls), 0U);  // the tree knows none
    return part;
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) grow(boxes[i], boxes_end[i]);
  part->boxes = std::move(boxes);
  return part;
}

template std::shared_ptr<const GeometryPart<float>> compile_geometry(
    const Scene&, std::shared_ptr<const SceneReach>, const GeometryPart<float>*);
template std::shared_ptr<const GeometryPart<double>> compile_geometry(
    const Scene&, std::shared_ptr<const SceneReach>, const GeometryPart<double>*);

}  // namespace lightbench
