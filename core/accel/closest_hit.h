#pragma once
// Closest and any hit. Tiny scenes: every primitive against all lanes at once. Others: each lane's
// ray walks the eight-wide BVH, one ray against eight boxes or eight triangles. Both find the same
// distance; of equal ones the smaller index wins, unless rounding hides its box behind the other.

#include "core/shapes/box.h"
#include "core/shapes/cylinder.h"
#include "core/shapes/disc.h"
#include "core/shapes/mesh.h"
#include "core/shapes/pyramid.h"
#include "core/shapes/rectangle.h"
#include "core/shapes/sphere.h"
#include "core/shapes/triangle.h"

LIGHTBENCH_KERNEL_BEGIN

/// Nearest hit so far; starts at the ray's end with primitive kNoHit.
struct NearestHit {
  Real t;
  Int primitive;
  Int slot;     ///< mesh: block * 8 + column
  Real b1, b2;  ///< triangles: barycentrics of the second and third vertex
};

inline NearestHit no_hit(Real t_max) { return {t_max, Int(kNoHit), Int(0U), Real(0), Real(0)}; }

constexpr bool is_planar(PrimitiveKind kind) {
  return kind == PrimitiveKind::Disc || kind == PrimitiveKind::Rectangle ||
         kind == PrimitiveKind::Triangle;
}

/// Interval of solid primitive i of the given kind.
template <PrimitiveKind kKind>
Interval solid_interval(const SceneView<T>& scene, std::uint32_t i, const Ray& ray) {
  const Row row{scene.rows + scene.row[i]};
  if constexpr (kKind == PrimitiveKind::Sphere)
    return hit_sphere(sphere_at(row, ray.time), ray, scene.hit_quality).span;
  if constexpr (kKind == PrimitiveKind::Ellipsoid) {
    return hit_ellipsoid(ellipsoid_at(row, ray.time), ray).span;
  }
  if constexpr (kKind == PrimitiveKind::Cylinder)
    return hit_cylinder(cylinder_at(row), ray, scene.hit_quality);
  if constexpr (kKind == PrimitiveKind::EllipticCylinder) {
    return hit_elliptic_cylinder(elliptic_cylinder_at(row), ray);
  }
  if constexpr (kKind == PrimitiveKind::Pyramid) return hit_pyramid(pyramid_at(row), ray);
  if constexpr (kKind == PrimitiveKind::Box) return hit_box(box_at(row), ray);
}

/// Calls f.operator()<kind>() for the kind of primitive i, which is not a mesh.
template <class F>
auto with_kind(const SceneView<T>& scene, std::uint32_t i, F f) {
  switch (static_cast<PrimitiveKind>(scene.kind[i])) {
    case PrimitiveKind::Sphere:
      return f.template operator()<PrimitiveKind::Sphere>();
    case PrimitiveKind::Ellipsoid:
      return f.template operator()<PrimitiveKind::Ellipsoid>();
    case PrimitiveKind::Cylinder:
      return f.template operator()<PrimitiveKind::Cylinder>();
    case PrimitiveKind::EllipticCylinder:
      return f.template operator()<PrimitiveKind::EllipticCylinder>();
    case PrimitiveKind::Disc:
      return f.template operator()<PrimitiveKind::Disc>();
    case PrimitiveKind::Rectangle:
      return f.template operator()<PrimitiveKind::Rectangle>();
    case PrimitiveKind::Triangle:
      return f.template operator()<PrimitiveKind::Triangle>();
    case PrimitiveKind::Pyramid:
      return f.template operator()<PrimitiveKind::Pyramid>();
    default:
      return f.template operator()<PrimitiveKind::Box>();
  }
}

/// The same for a kind known only at run time, such as a medium's boundary.
inline Interval solid_interval(const SceneView<T>& scene, std::uint32_t i, const Ray& ray) {
  return with_kind(scene, i, [&]<PrimitiveKind kKind>() -> Interval {
    if constexpr (is_planar(kKind)) {
      return {Real(0), Real(0), Mask(false)};
    } else {
      return solid_interval<kKind>(scene, i, ray);
    }
  });
}

/// Of equal distances the primitive with the smaller index wins. Where primitives are tested by
/// rising index, the first simply stays.
enum class TestOrder { Rising, Any };

/// Ray against analytic primitive i in all active lanes.
template <bool kShadow, PrimitiveKind kKind, TestOrder kOrder>
inline void test_primitive(const SceneView<T>& scene, std::uint32_t i, const Ray& ray, Mask active,
                           NearestHit& hit) {
  const Row row{scene.rows + scene.row[i]};
  const Mask self = ray.from == Int(i);
  const auto report = [&](Real t, Mask m) {
    Mask nearer = t < hit.t;
    if (kOrder == TestOrder::Any) nearer = nearer || (t == hit.t && Int(i) < hit.primitive);
    m = m && active && nearer;
    hit.t = select(m, t, hit.t);
    hit.primitive = select(m, Int(i), hit.primitive);
    return m;
  };
  if constexpr (is_planar(kKind)) {
    const Mask barred = kShadow ? self || ray.skip == Int(i) : self;
    if constexpr (kKind == PrimitiveKind::Triangle) {
      const TriangleHit h = hit_triangle(triangle_at(row), ray);
      const Mask m = report(h.t, h.hit && !barred && h.t > Real(0));
      hit.b1 = select(m, h.b1, hit.b1);
      hit.b2 = select(m, h.b2, hit.b2);
    } else {
      PlaneHit h;
      if constexpr (kKind == PrimitiveKind::Disc) h = hit_disc(disc_at(row), ray);
      if constexpr (kKind == PrimitiveKind::Rectangle) h = hit_rectangle(rectangle_at(row), ray);
      report(h.t, h.hit && !barred && h.t > Real(0));
    }
  } else {
    const Interval s = solid_interval<kKind>(scene, i, ray);
    Mask entry = s.hit && s.near > Real(0) && !self;
    Mask exit = s.hit && s.far > Real(0) && (!self || ray.inside);
    if (kShadow) {
      const Mask target = ray.skip == Int(i);
      entry = entry && (!target || ray.skip_back);
      exit = exit && !target;
    }
    report(select(entry, s.near, s.far), entry || exit);
  }
}

/// All surfaces of one kind.
template <bool kShadow, PrimitiveKind kKind>
inline void test_run(const SceneView<T>& scene, const Ray& ray, Mask active, NearestHit& hit) {
  constexpr auto k = static_cast<unsigned>(kKind);
  const std::uint32_t end = scene.kind_begin[k + 1];
  for (std::uint32_t i = scene.kind_begin[k]; i < end; ++i) {
    test_primitive<kShadow, kKind, TestOrder::Rising>(scene, i, ray, active, hit);
  }
}

/// Every surface against all lanes.
template <bool kShadow>
void test_all(const SceneView<T>& scene, const Ray& ray, Mask active, NearestHit& hit) {
  test_run<kShadow, PrimitiveKind::Sphere>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Ellipsoid>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Cylinder>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::EllipticCylinder>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Disc>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Rectangle>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Triangle>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Pyramid>(scene, ray, active, hit);
  test_run<kShadow, PrimitiveKind::Box>(scene, ray, active, hit);
}

/// One ray as plain numbers, for walking a tree.
struct SingleRay {
  T o[3], d[3], inverse[3];
  T time;
  std::uint32_t from, from_slot, skip, skip_slot;
  bool inside, skip_back;
};

/// Visits the leaves that the ray meets before t_max, nearer boxes first; `leaf(child)` returns
/// true to stop. Boxes are widened by rounding error (Ize, JCGT 2:2, 2013), so no hit is missed.
template <class Leaf>
bool walk(const BvhNode* nodes, const BvhMotion* motion, const SingleRay& ray, const T& t_max,
          Leaf leaf) {
  struct Entry {
    std::uint32_t child;
    T near;
  };
  constexpr T kWiden = T(1) + 12 * kEpsilon;
  Entry stack[512];
  int size = 0;
  stack[size++] = {0, T(0)};
  const bool negative[3] = {ray.inverse[0] < 0, ray.inverse[1] < 0, ray.inverse[2] < 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.near > t_max * kWiden) continue;
    if (is_leaf(entry.child)) {
      if (leaf(entry.child)) return true;
      continue;
    }
    const BvhNode& node = nodes[entry.child];
    alignas(64) T near_of[kBvhWidth + kLanes];
    std::uint32_t hits = 0;
    for (int k = 0; k < kBvhWidth; k += kLanes) {
      Real near(0), far(t_max);
      for (int a = 0; a < 3; ++a) {
        Real lo = load_of_8(node.lo[a] + k), hi = load_of_8(node.hi[a] + k);
        if (motion != nullptr) {
          const BvhMotion& m = motion[entry.child];
          lo = fma(load_of_8(m.lo[a] + k), Real(ray.time), lo);
          hi = fma(load_of_8(m.hi[a] + k), Real(ray.time), hi);
        }
        const Real first = negative[a] ? hi : lo, last = negative[a] ? lo : hi;
        // 0 * inf is NaN where the ray runs within a box's face: max and min then ignore this axis.
        near = max((first - Real(ray.o[a])) * Real(ray.inverse[a]), near);
        far = min((last - Real(ray.o[a])) * Real(ray.inverse[a]), far);
      }
      store(near_of + k, near);
      hits |= bits(near <= far * kWiden) << k;
    }
    hits &= (1U << kBvhWidth) - 1U;
    // Insertion sort into the stack, farthest first.
    const int base = size;
    for (; hits != 0; hits &= hits - 1) {
      const int k = __builtin_ctz(hits);
      int at = size++;
      while (at > base && stack[at - 1].near < near_of[k]) {
        stack[at] = stack[at - 1];
        --at;
      }
      stack[at] = {node.child[k], near_of[k]};
    }
  }
  return false;
}

/// Distance and triangle of a mesh's nearest hit in (t_min, t).
struct MeshHit {
  T t;
  std::uint32_t slot;
  T b1, b2;
  bool found, front;
};

/// Ray (already in the mesh's space) against a mesh. Skips the triangles named by from_slot and
/// skip_slot (kNoHit for none).
template <bool kShadow>
MeshHit hit_mesh(const MeshView<T>& mesh, const SingleRay& ray, T t_min, T t_max) {
  // Largest component of the direction last, as Woop's shear wants.
  const T ax = ray.d[0] < 0 ? -ray.d[0] : ray.d[0], ay = ray.d[1] < 0 ? -ray.d[1] : ray.d[1];
  const T az = ray.d[2] < 0 ? -ray.d[2] : ray.d[2];
  const unsigned z = ax >= ay && ax >= az ? 0U : (ay >= az ? 1U : 2U);
  const unsigned x = (z + 1) % 3, y = (z + 2) % 3;
  const T sz = T(1) / ray.d[z], sx = ray.d[x] * sz, sy = ray.d[y] * sz;
  MeshHit best{t_max, kNoHit, 0, 0, false, false};
  walk(mesh.nodes, nullptr, ray, best.t, [&](std::uint32_t child) {
    const std::uint32_t first_block = leaf_first(child);
    for (std::uint32_t b = first_block; b < first_block + leaf_count(child); ++b) {
      const TriangleBlock<T>& block = mesh.blocks[b];
      for (int k = 0; k < kBvhWidth; k += kLanes) {
        const auto vertex = [&](unsigned i) {
          return Vec{load_of_8(block.v[3 * i + x] + k) - Real(ray.o[x]),
                     load_of_8(block.v[3 * i + y] + k) - Real(ray.o[y]),
                     load_of_8(block.v[3 * i + z] + k) - Real(ray.o[z])};
        };
        const TriangleHit h =
            hit_sheared(vertex(0), vertex(1), vertex(2), Real(sx), Real(sy), Real(sz));
        std::uint32_t m = bits(h.hit && h.t > Real(t_min) && h.t <= Real(best.t));
        m &= (1U << (kBvhWidth - k)) - 1U;
        if (m == 0) continue;
        alignas(64) T ts[kLanes], b1[kLanes], b2[kLanes];
        store(ts, h.t);
        store(b1, h.b1);
        store(b2, h.b2);
        for (; m != 0; m &= m - 1) {
          const auto lane = static_cast<unsigned>(__builtin_ctz(m));
          const std::uint32_t slot = b * kBvhWidth + static_cast<unsigned>(k) + lane;
          if (slot == ray.from_slot || slot == ray.skip_slot) continue;
          if (ts[lane] < best.t || (ts[lane] == best.t && slot < best.slot)) {
            best = {ts[lane], slot, b1[lane], b2[lane], true, false};
            if (kShadow) return true;
          }
        }
      }
    }
    return false;
  });
  return best;
}

/// The ray in the space of mesh instance i.
inline SingleRay to_mesh_space(const SceneView<T>& scene, std::uint32_t i, const SingleRay& ray) {
  const T* m = scene.rows + scene.row[i];
  SingleRay r = ray;
  for (unsigned a = 0; a < 3; ++a) {
    r.o[a] = m[4 * a] * ray.o[0] + m[4 * a + 1] * ray.o[1] + m[4 * a + 2] * ray.o[2] + m[4 * a + 3];
    r.d[a] = m[4 * a] * ray.d[0] + m[4 * a + 1] * ray.d[1] + m[4 * a + 2] * ray.d[2];
    r.inverse[a] = T(1) / r.d[a];
  }
  r.from_slot = ray.from == i ? ray.from_slot : kNoHit;
  r.skip_slot = ray.skip == i ? ray.skip_slot : kNoHit;
  return r;
}
inline const MeshView<T>& mesh_of(const SceneView<T>& scene, std::uint32_t i) {
  return scene.meshes[static_cast<std::uint32_t>(scene.rows[scene.row[i] + MeshInstance::kRow])];
}

/// All lanes' rays as plain numbers.
struct RayTable {
  alignas(64) T o[3][kLanes], d[3][kLanes], time[kLanes];
  alignas(64) std::uint32_t from[kLanes], from_slot[kLanes], skip[kLanes], skip_slot[kLanes];
  std::uint32_t inside, skip_back;
  explicit RayTable(const Ray& r) : inside(bits(r.inside)), skip_back(bits(r.skip_back)) {
    store(o[0], r.o.x);
    store(o[1], r.o.y);
    store(o[2], r.o.z);
    store(d[0], r.d.x);
    store(d[1], r.d.y);
    store(d[2], r.d.z);
    store(time, r.time);
    store(from, r.from);
    store(from_slot, r.from_slot);
    store(skip, r.skip);
    store(skip_slot, r.skip_slot);
  }
  [[nodiscard]] SingleRay single(unsigned lane) const {
    SingleRay s;
    for (unsigned a = 0; a < 3; ++a) {
      s.o[a] = o[a][lane];
      s.d[a] = d[a][lane];
      s.inverse[a] = T(1) / s.d[a];
    }
    s.time = time[lane];
    s.from = from[lane];
    s.from_slot = from_slot[lane];
    s.skip = skip[lane];
    s.skip_slot = skip_slot[lane];
    s.inside = ((inside >> lane) & 1U) != 0;
    s.skip_back = ((skip_back >> lane) & 1U) != 0;
    return s;
  }
};

/// The same ray in every lane.
inline Ray broadcast_ray(const SingleRay& s) {
  return {{Real(s.o[0]), Real(s.o[1]), Real(s.o[2])},
          {Real(s.d[0]), Real(s.d[1]), Real(s.d[2])},
          Real(s.time),
          Int(s.from),
          Int(s.from_slot),
          Mask(s.inside),
          Int(s.skip),
          Int(s.skip_slot),
          Mask(s.skip_back)};
}

/// Finds the nearest hits before hit.t; with kShadow any hit will do. Never inlined: within the
/// step of the path tracer it would take the inliner's budget from what is called there once per
/// path.
template <bool kShadow>
[[gnu::noinline]] void find_hits(const SceneView<T>& scene, const Ray& ray, Mask active,
                                 NearestHit& hit) {
  if (scene.nodes == nullptr) {
    test_all<kShadow>(scene, ray, active, hit);
    return;
  }
  const RayTable rays(ray);
  alignas(64) T t[kLanes], b1[kLanes], b2[kLanes];
  alignas(64) std::uint32_t primitive[kLanes], slot[kLanes];
  store(t, hit.t);
  store(b1, hit.b1);
  store(b2, hit.b2);
  store(primitive, hit.primitive);
  store(slot, hit.slot);
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const SingleRay one = rays.single(lane);
    const Ray all = broadcast_ray(one);
    walk(scene.nodes, scene.motion, one, t[lane], [&](std::uint32_t child) {
      const std::uint32_t end = leaf_first(child) + leaf_count(child);
      for (std::uint32_t k = leaf_first(child); k < end; ++k) {
        const std::uint32_t i = scene.leaves[k];
        if (scene.kind[i] == static_cast<std::uint32_t>(PrimitiveKind::Mesh)) {
          const MeshHit h =
              hit_mesh<kShadow>(mesh_of(scene, i), to_mesh_space(scene, i, one), T(0), t[lane]);
          if (h.found && (h.t < t[lane] || i < primitive[lane])) {
            t[lane] = h.t;
            b1[lane] = h.b1;
            b2[lane] = h.b2;
            primitive[lane] = i;
            slot[lane] = h.slot;
          }
        } else {
          NearestHit h{Real(t[lane]), Int(primitive[lane]), Int(0U), Real(b1[lane]),
                       Real(b2[lane])};
          with_kind(scene, i, [&]<PrimitiveKind kKind>() {
            test_primitive<kShadow, kKind, TestOrder::Any>(scene, i, all, Mask(true), h);
          });
          t[lane] = first(h.t);
          b1[lane] = first(h.b1);
          b2[lane] = first(h.b2);
          primitive[lane] = first(h.primitive);
        }
        if (kShadow && primitive[lane] != kNoHit) return true;
      }
      return false;
    });
  }
  hit = {load(t), load(primitive), load(slot), load(b1), load(b2)};
}

/// Distance and barycentrics of found hits on triangles, to the last bits. It comes after the
/// choice of the nearest, which goes by what the tests gave: so it costs once per ray, not once per
/// test.
inline void refine_hits(const SceneView<T>& scene, const Ray& ray, NearestHit& hit) {
  const auto of_kind = [&](PrimitiveKind kind) {
    const auto k = static_cast<unsigned>(kind);
    return hit.primitive >= Int(scene.kind_begin[k]) &&
           hit.primitive < Int(scene.kind_begin[k + 1]);
  };
  const Mask meshes = of_kind(PrimitiveKind::Mesh);
  const Mask triangles = meshes || of_kind(PrimitiveKind::Triangle);
  if (none(triangles)) return;
  for_each_distinct(hit.primitive, triangles, [&](std::uint32_t i, Mask m) {
    const Row row{scene.rows + scene.row[i]};
    TriangleHit h{hit.t, hit.b1, hit.b2, m};
    if (static_cast<PrimitiveKind>(scene.kind[i]) == PrimitiveKind::Mesh) {
      const Affine to_local = mesh_at(row).to_local;
      h = refine_triangle(fetch_triangle(mesh_of(scene, i), hit.slot, m).vertices,
                          to_local.point(ray.o), to_local.vector(ray.d), h);
    } else {
      h = refine_triangle(triangle_at(row), ray.o, ray.d, h);
    }
    hit.t = select(m, h.t, hit.t);
    hit.b1 = select(m, h.b1, hit.b1);
    hit.b2 = select(m, h.b2, hit.b2);
  });
}

/// Surface of the hits on primitive i; meaningful in the active lanes, all of which hit it. Never
/// inlined, like find_hits().
[[gnu::noinline]] inline Surface surface_of(const SceneView<T>& scene, std::uint32_t i,
                                            const Ray& ray, const NearestHit& hit, Mask active,
                                            Coordinates uv) {
  const Row row{scene.rows + scene.row[i]};
  switch (static_cast<PrimitiveKind>(scene.kind[i])) {
    case PrimitiveKind::Sphere:
      return surface_sphere(sphere_at(row, ray.time), ray, hit.t, scene.hit_quality, uv);
    case PrimitiveKind::Ellipsoid:
      return surface_ellipsoid(ellipsoid_at(row, ray.time), ray, hit.t, uv);
    case PrimitiveKind::Cylinder:
      return surface_cylinder(cylinder_at(row), ray, hit.t, scene.hit_quality, uv);
    case PrimitiveKind::EllipticCylinder:
      return surface_elliptic_cylinder(elliptic_cylinder_at(row), ray, hit.t, uv);
    case PrimitiveKind::Disc:
      return surface_disc(disc_at(row), ray, hit.t, uv);
    case PrimitiveKind::Rectangle:
      return surface_rectangle(rectangle_at(row), ray, hit.t, uv);
    case PrimitiveKind::Triangle:
      return surface_triangle(triangle_at(row), hit.b1, hit.b2, uv);
    case PrimitiveKind::Pyramid:
      return surface_pyramid(pyramid_at(row), ray, hit.t, uv);
    case PrimitiveKind::Box:
      return surface_box(box_at(row), ray, hit.t, uv);
    case PrimitiveKind::Mesh:
      break;
  }
  return surface_mesh(mesh_at(row), fetch_triangle(mesh_of(scene, i), hit.slot, active), hit.b1,
                      hit.b2, uv);
}

/// All but the tangent, which paths have no use for.
inline void merge(Mask m, const Surface& from, Surface& into) {
  into.p = select(m, from.p, into.p);
  into.ng = select(m, from.ng, into.ng);
  into.ns = select(m, from.ns, into.ns);
  into.u = select(m, from.u, into.u);
  into.v = select(m, from.v, into.v);
}

LIGHTBENCH_KERNEL_END
