#include "tests/bench/micro/embree.h"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace lightbench::micro {
namespace {

template <class Item>
void copy_to(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
             std::span<const Item> items) {
  void* to = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
  std::memcpy(to, items.data(), items.size_bytes());
}

void commit(RTCScene scene, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(scene);
}

const SphereNumbers& sphere_at(const void* spheres, unsigned i) {
  return static_cast<const SphereNumbers*>(spheres)[i];
}

void sphere_bounds(const RTCBoundsFunctionArguments* arguments) {
  const SphereNumbers& s = sphere_at(arguments->geometryUserPtr, arguments->primID);
  RTCBounds& b = *arguments->bounds_o;
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const auto low = [&](std::size_t k) { return std::nextafter(s[k] - s[3], -kInf); };
  const auto high = [&](std::size_t k) { return std::nextafter(s[k] + s[3], kInf); };
  b.lower_x = low(0);
  b.lower_y = low(1);
  b.lower_z = low(2);
  b.upper_x = high(0);
  b.upper_y = high(1);
  b.upper_z = high(2);
}

/// Distance at which a ray of unit direction meets the sphere within its range, or a negative
/// number. From the closest approach as in our kernel, without the step that refines it.
float hit_sphere(const SphereNumbers& s, const RTCRay& r) {
  const float f[3] = {r.org_x - s[0], r.org_y - s[1], r.org_z - s[2]};
  const float t = -(f[0] * r.dir_x + f[1] * r.dir_y + f[2] * r.dir_z);
  const float p[3] = {f[0] + t * r.dir_x, f[1] + t * r.dir_y, f[2] + t * r.dir_z};
  const float discriminant = s[3] * s[3] - (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  if (!(discriminant > 0)) return -1;
  const float half = std::sqrt(discriminant);
  const float hit = t - half > r.tnear ? t - half : t + half;
  return hit > r.tnear && hit <= r.tfar ? hit : -1;
}

void intersect_sphere(const RTCIntersectFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& r = *reinterpret_cast<RTCRayHit*>(arguments->rayhit);
  const float t = hit_sphere(sphere_at(arguments->geometryUserPtr, arguments->primID), r.ray);
  if (t < 0) return;
  r.ray.tfar = t;
  r.hit.primID = arguments->primID;
  r.hit.geomID = arguments->geomID;
}

void occlude_sphere(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  auto& r = *reinterpret_cast<RTCRay*>(arguments->ray);
  if (hit_sphere(sphere_at(arguments->geometryUserPtr, arguments->primID), r) < 0) return;
  r.tfar = -std::numeric_limits<float>::infinity();
}

}  // namespace

EmbreeScene::EmbreeScene(std::span<const std::array<float, 3>> vertices,
                         std::span<const std::array<std::uint32_t, 3>> triangles, bool robust)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  copy_to(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
  copy_to(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  commit(scene_, geometry);
}

EmbreeScene::EmbreeScene(std::span<const SphereNumbers> spheres, Spheres tested)
    : device_(rtcNewDevice(nullptr)),
      scene_(rtcNewScene(device_)),
      spheres_(spheres.begin(), spheres.end()) {
  const bool user = tested == Spheres::User;
  RTCGeometry geometry =
      rtcNewGeometry(device_, user ? RTC_GEOMETRY_TYPE_USER : RTC_GEOMETRY_TYPE_SPHERE_POINT);
  if (user) {
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(spheres_.size()));
    rtcSetGeometryUserData(geometry, spheres_.data());
    rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, intersect_sphere);
    rtcSetGeometryOccludedFunction(geometry, occlude_sphere);
  } else {
    copy_to(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres);
  }
  commit(scene_, geometry);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

namespace {

RTCRay ray_at(const RaySet& rays, std::size_t i) {
  RTCRay r{};
  r.org_x = rays.o[0][i];
  r.org_y = rays.o[1][i];
  r.org_z = rays.o[2][i];
  r.dir_x = rays.d[0][i];
  r.dir_y = rays.d[1][i];
  r.dir_z = rays.d[2][i];
  r.tfar = rays.t_max[i];
  r.mask = ~0U;
  return r;
}

}  // namespace

void EmbreeScene::closest(const RaySet& rays, std::span<Answer> answers) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < rays.padded(); ++i) {
    RTCRayHit r{ray_at(rays, i), {}};
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &r);
    const bool hit = r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    answers[i] = {r.ray.tfar, hit ? 0U : kNoHit, r.hit.primID};
  }
}

void EmbreeScene::any(const RaySet& rays, std::span<Answer> answers) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = 0; i < rays.padded(); ++i) {
    RTCRay r = ray_at(rays, i);
    rtcOccluded1(scene_, &context, &r);
    answers[i].primitive = r.tfar < 0 ? 0U : kNoHit;
  }
}

}  // namespace lightbench::micro
