#include "tests/bench/micro/embree.h"

#include <embree3/rtcore.h>

#include <cstring>

namespace lightbench::micro {

EmbreeScene::EmbreeScene(std::span<const std::array<float, 3>> vertices,
                         std::span<const std::array<std::uint32_t, 3>> triangles, bool robust)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  rtcSetSceneFlags(scene_, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* v = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof vertices[0], vertices.size());
  std::memcpy(v, vertices.data(), vertices.size_bytes());
  void* i = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof triangles[0], triangles.size());
  std::memcpy(i, triangles.data(), triangles.size_bytes());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
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
