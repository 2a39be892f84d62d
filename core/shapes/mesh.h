#pragma once
// Instanced triangle mesh. Rows hold the maps between render space and the mesh's own space, in
// which its BVH and triangles live; t is the same in both.

#include "core/shapes/triangle.h"

LIGHTBENCH_KERNEL_BEGIN

struct MeshInstance {
  static constexpr unsigned kRow = kMeshRow;  ///< then the index of the mesh
  Affine to_local, to_world;
};

inline MeshInstance mesh_at(const auto& row) { return {affine_at(row, 0), affine_at(row, 12)}; }

/// The mesh of instance i.
inline const MeshView<T>& mesh_of(const SceneView<T>& scene, std::uint32_t i) {
  return scene.meshes[static_cast<std::uint32_t>(scene.rows[scene.row[i] + MeshInstance::kRow])];
}

/// One triangle of a mesh per lane.
struct MeshTriangle {
  Triangle vertices;  ///< mesh space
  Vec normals[3];     ///< all zero if the mesh has none
  Vec2 uvs[3];
  Mask has_uvs;
};

/// In mesh space, of each active lane's mesh instance.
inline Triangle fetch_vertices(const SceneView<T>& scene, Int primitive, Int slot, Mask active) {
  alignas(64) std::uint32_t primitives[kLanes], slots[kLanes];
  alignas(64) T v[9][kLanes] = {};
  store(primitives, primitive);
  store(slots, slot);
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const MeshView<T>& mesh = mesh_of(scene, primitives[lane]);
    const TriangleBlock<T>& block = mesh.blocks[slots[lane] / kBvhWidth];
    const std::uint32_t column = slots[lane] % kBvhWidth;
    for (unsigned k = 0; k < 9; ++k) v[k][lane] = block.v[k][column];
  }
  const auto vec = [&v](unsigned i) { return Vec{load(v[i]), load(v[i + 1]), load(v[i + 2])}; };
  return {vec(0), vec(3), vec(6)};
}

/// The same with normals and uvs, which lie where the scene's mesh has them.
inline MeshTriangle fetch_triangles(const SceneView<T>& scene, Int primitive, Int slot,
                                    Mask active) {
  alignas(64) std::uint32_t primitives[kLanes], at[kLanes], vertices[3][kLanes];
  alignas(64) T n[9][kLanes] = {}, uv[6][kLanes] = {};
  store(primitives, primitive);
  store(at, slot);
  const auto each_lane = [](std::uint32_t lanes, auto f) {
    for (; lanes != 0; lanes &= lanes - 1) f(static_cast<unsigned>(__builtin_ctz(lanes)));
  };
  std::uint32_t with_normals = 0, with_uvs = 0;
  each_lane(bits(active), [&](unsigned lane) {
    const MeshView<T>& mesh = mesh_of(scene, primitives[lane]);
    with_normals |= mesh.normals != nullptr ? 1U << lane : 0U;
    with_uvs |= mesh.uvs != nullptr ? 1U << lane : 0U;
  });
  // Step by step for all lanes, so that their waits for memory overlap.
  each_lane(with_normals | with_uvs, [&](unsigned lane) {
    at[lane] = mesh_of(scene, primitives[lane]).slot_triangle[at[lane]];
  });
  each_lane(with_normals | with_uvs, [&](unsigned lane) {
    const std::uint32_t* triangle =
        mesh_of(scene, primitives[lane]).triangles + std::size_t{3} * at[lane];
    for (unsigned i = 0; i < 3; ++i) vertices[i][lane] = triangle[i];
  });
  each_lane(with_normals, [&](unsigned lane) {
    const double* normals = mesh_of(scene, primitives[lane]).normals;
    for (unsigned i = 0; i < 3; ++i) {
      const double* normal = normals + std::size_t{3} * vertices[i][lane];
      for (unsigned k = 0; k < 3; ++k) n[3 * i + k][lane] = static_cast<T>(normal[k]);
    }
  });
  each_lane(with_uvs, [&](unsigned lane) {
    const double* uvs = mesh_of(scene, primitives[lane]).uvs;
    for (unsigned i = 0; i < 3; ++i) {
      const double* corner = uvs + std::size_t{2} * vertices[i][lane];
      for (unsigned k = 0; k < 2; ++k) uv[2 * i + k][lane] = static_cast<T>(corner[k]);
    }
  });
  MeshTriangle r;
  r.vertices = fetch_vertices(scene, primitive, slot, active);
  for (unsigned i = 0; i < 3; ++i) {
    r.normals[i] = {load(n[3 * i]), load(n[3 * i + 1]), load(n[3 * i + 2])};
    r.uvs[i] = {load(uv[2 * i]), load(uv[2 * i + 1])};
  }
  r.has_uvs = mask_from_bits(with_uvs);
  return r;
}

inline Triangle to_world(const MeshInstance& m, const Triangle& t) {
  return {m.to_world.point(t.a), m.to_world.point(t.b), m.to_world.point(t.c)};
}

/// uv: the mesh's, or the barycentrics. The geometric normal follows the triangle's winding in
/// object space whatever the instance's handedness.
inline Surface surface_mesh(const MeshInstance& m, const MeshTriangle& t, Real b1, Real b2,
                            Coordinates uv) {
  const Vec e1 = t.vertices.b - t.vertices.a, e2 = t.vertices.c - t.vertices.a;
  Surface r;
  r.p = m.to_world.point(madd(e1, b1, madd(e2, b2, t.vertices.a)));
  r.ng = normalize(m.to_local.transposed(cross(e1, e2)));
  const Real b0 = Real(1) - b1 - b2;
  const Vec shading = madd(t.normals[0], b0, madd(t.normals[1], b1, t.normals[2] * b2));
  const Vec ns = m.to_local.transposed(shading);
  const Real squared = length_squared(ns);
  r.ns = select(squared > Real(0),
                ns * (Real(1) / sqrt(select(squared > Real(0), squared, Real(1)))), r.ng);
  if (uv == Coordinates::None) return r;
  r.u = select(t.has_uvs, fma(t.uvs[0].x, b0, fma(t.uvs[1].x, b1, t.uvs[2].x * b2)), b1);
  r.v = select(t.has_uvs, fma(t.uvs[0].y, b0, fma(t.uvs[1].y, b1, t.uvs[2].y * b2)), b2);
  // dp/du with v held; along the first edge where the uvs do not tell.
  const Vec2 d1{t.uvs[1].x - t.uvs[0].x, t.uvs[1].y - t.uvs[0].y};
  const Vec2 d2{t.uvs[2].x - t.uvs[0].x, t.uvs[2].y - t.uvs[0].y};
  const Real turn = d1.x * d2.y - d2.x * d1.y;
  const Vec along = (e1 * d2.y - e2 * d1.y) * copysign(Real(1), turn);
  r.tangent = normalize(m.to_world.vector(select(turn == Real(0), e1, along)));
  return r;
}

LIGHTBENCH_KERNEL_END
