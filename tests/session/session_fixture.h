#pragma once
// Scenes and helpers that the session tests share.

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <vector>

#include "core/session/session.h"

namespace lightbench {

/// Nothing but an environment of one colour: every pixel of every frame is exactly that colour.
inline Scene plain_scene(int width, int height, double radiance) {
  Scene scene;
  scene.render.width = width;
  scene.render.height = height;
  scene.render.spp = 0;
  scene.render.snapshots.clear();
  scene.environment.color = glm::dvec3(radiance);
  return scene;
}

/// A grey sphere under a bright sphere: noisy, so that frames tell which samples they hold.
inline Scene noisy_scene(int width, int height, int spp) {
  Scene scene = plain_scene(width, height, 0.125);
  scene.render.spp = spp;
  Material lamp;
  lamp.kind = MaterialKind::Emissive;
  lamp.emissive = glm::dvec3(5);
  scene.materials = {Material{}, lamp};
  Object ball, light;
  ball.material = 0;
  light.shape = SphereShape{.center = {2, 3, 1}, .radius = 0.5};
  light.material = 1;
  scene.objects = {ball, light};
  return scene;
}

inline bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Waits until `condition()` holds; fails the test after a time no healthy run needs.
template <class Condition>
bool eventually(const Session& session, Condition condition) {
  const auto start = std::chrono::steady_clock::now();
  while (!condition()) {
    if (seconds_since(start) > 60) {
      ADD_FAILURE() << "nothing happened for 60 s";
      return false;
    }
    const auto frame = session.latest();
    session.wait(frame ? frame->serial : 0, 0.002);
  }
  return true;
}

inline bool finish(const Session& session) {
  return eventually(session, [&] { return session.status().state == SessionState::Finished; });
}

/// The last frame of a headless render.
inline std::shared_ptr<const Frame> render_to_end(const Scene& scene, int threads = 2) {
  Session session({.threads = threads});
  session.submit(scene);
  return finish(session) ? session.latest() : nullptr;
}

}  // namespace lightbench
