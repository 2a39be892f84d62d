#include "app/proof/same_world.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "app/proof/measure.h"

namespace lightbench::proof {

Scene in_other_units(Scene s, double scale, const glm::dvec3& shift) {
  const auto move = [&](glm::dvec3& p) { p = p * scale + shift; };
  move(s.camera.look_from);
  move(s.camera.look_at);
  s.camera.focus_distance *= scale;
  s.camera.lens_radius *= scale;
  for (Object& o : s.objects) {
    move(o.transform.translation);
    o.transform.scale *= scale;
  }
  for (Medium& m : s.media) m.density /= scale;
  return s;
}

Scene turned_world(Scene s, const glm::dvec3& axis, double degrees) {
  const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
  const auto move = [&](glm::dvec3& p) { p = turn * p; };
  move(s.camera.look_from);
  move(s.camera.look_at);
  move(s.camera.up);
  for (Object& o : s.objects) {
    Transform& t = o.transform;
    move(t.translation);
    const glm::dquat both = turn * glm::angleAxis(glm::radians(t.degrees), glm::normalize(t.axis));
    const glm::dvec3 v(both.x, both.y, both.z);
    t.degrees = glm::degrees(2 * std::atan2(glm::length(v), both.w));
    if (glm::length(v) > 0) t.axis = v;
  }
  return s;
}

Scene mirrored_world(Scene s) {
  const auto mirror = [](glm::dvec3& p) { p.x = -p.x; };
  mirror(s.camera.look_from);
  mirror(s.camera.look_at);
  mirror(s.camera.up);
  for (Object& o : s.objects) {
    // M T R S = (M T) (M R M) (M S), and M R M turns the other way about the mirrored axis.
    mirror(o.transform.translation);
    mirror(o.transform.axis);
    o.transform.degrees = -o.transform.degrees;
    o.transform.scale.x = -o.transform.scale.x;
  }
  return s;
}

PictureDifference picture_difference(const Film& a, const Film& b, int spp) {
  double sum_a = 0, sum_b = 0, absolute = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const double x = pixel_mean(a, i, spp).y, y = pixel_mean(b, i, spp).y;
    sum_a += x;
    sum_b += y;
    absolute += std::abs(x - y);
  }
  return {sum_b / sum_a, absolute / sum_a};
}

}  // namespace lightbench::proof
