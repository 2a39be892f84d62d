#include "app/path_text.h"

#include <fmt/format.h>

namespace lightbench {
namespace {

std::string triple(const glm::dvec3& v) {
  return fmt::format("({:.9g} {:.9g} {:.9g})", v.x, v.y, v.z);
}

const char* material_kind(const Material& m) {
  switch (m.kind) {
    case MaterialKind::Lambertian:
      return "lambertian";
    case MaterialKind::Metal:
      return m.fuzz > 0 ? "fuzzy metal" : m.roughness > 0 ? "rough metal" : "mirror";
    case MaterialKind::Dielectric:
      return "dielectric";
    case MaterialKind::Emissive:
      return "emissive";
  }
  return "";
}

const char* end_text(PathEnd end) {
  switch (end) {
    case PathEnd::Escaped:
      return "it leaves the scene";
    case PathEnd::Depth:
      return "it has as many segments as the scene allows (maxDepth)";
    case PathEnd::Black:
      return "the surface reflects nothing";
    case PathEnd::Absorbed:
      return "the sampled direction is absorbed";
    case PathEnd::Roulette:
      return "Russian roulette";
    case PathEnd::NoThroughput:
      return "nothing is left of its throughput";
  }
  return "";
}

std::string object_name(const Scene& scene, int object) {
  return "'" + scene.objects[static_cast<std::size_t>(object)].name + "'";
}

std::string place_text(const Scene& scene, const PathVertex& v) {
  if (v.in_medium) {
    return fmt::format("in a medium of albedo {} at {}, {:.9g} away\n", triple(v.base_color),
                       triple(v.position), v.distance);
  }
  if (v.object == kNone) return "nothing: the environment\n";
  const Object& object = scene.objects[static_cast<std::size_t>(v.object)];
  const Material& material = scene.materials[static_cast<std::size_t>(object.material)];
  return fmt::format(
      "{}{} from {}, material '{}' ({}), base color {}\n"
      "   at         {}, {:.9g} away\n"
      "   normal     {} geometric, {} shading\n",
      object_name(scene, v.object),
      v.triangle == kNone ? "" : fmt::format(" triangle {}", v.triangle),
      v.front ? "outside" : "inside", material.name, material_kind(material), triple(v.base_color),
      triple(v.position), v.distance, triple(v.geometric_normal), triple(v.shading_normal));
}

std::string way_text(const Scene& scene, int via) {
  if (via == kNone) return "";
  const Object& object = scene.objects[static_cast<std::size_t>(via)];
  const Material& material = scene.materials[static_cast<std::size_t>(object.material)];
  const bool glass = material.kind == MaterialKind::Dielectric;
  return (glass ? " through " : " in the mirror ") + object_name(scene, via);
}

std::string light_text(const Scene& scene, const RenderScene& compiled, const LightTry& light) {
  const LightPoint& p = light.point;
  std::string text = fmt::format("   light      {}{} chosen with probability {:.9g}: ",
                                 object_name(scene, light_source(compiled, p.light).object),
                                 way_text(scene, light.via), p.selection);
  if (!p.valid) return text + "no point of it can be seen from here\n";
  text += fmt::format(
      "direction {}, {:.9g} away, pdf {:.9g} /sr\n"
      "              radiance {}, BSDF*cos {} of pdf {:.9g}, weight {:.9g}\n",
      triple(p.direction), p.distance, p.pdf, triple(p.radiance), triple(light.value),
      light.value_pdf, light.weight);
  if (light.visible) return text + fmt::format("              adds {}\n", triple(light.added));
  if (light.blocker != kNone) {
    return text + fmt::format("              hidden by {}\n", object_name(scene, light.blocker));
  }
  return text +
         "              adds nothing: it shines the other way, or the surface does not take it\n";
}

std::string vertex_text(const Scene& scene, const RenderScene& compiled, std::size_t number,
                        const PathVertex& v) {
  std::string text =
      fmt::format("{} ray        from {} to {}", number, triple(v.origin), triple(v.direction));
  if (scene.camera.shutter_close > scene.camera.shutter_open)
    text += fmt::format(", time {:.9g}", v.time);
  text += fmt::format("\n   throughput {}\n   meets      {}", triple(v.throughput),
                      place_text(scene, v));
  if (v.emission) {
    text += fmt::format("   emission   {}, weight {:.9g}: adds {}\n", triple(v.emission->radiance),
                        v.emission->weight,
                        triple(v.throughput * v.emission->radiance * v.emission->weight));
  }
  if (v.light) text += light_text(scene, compiled, *v.light);
  if (v.scattered) {
    const BsdfSample& s = *v.scattered;
    text += fmt::format("   scatters   to {}, {}, weight {}{}\n", triple(s.wi),
                        s.delta ? std::string("delta") : fmt::format("pdf {:.9g} /sr", s.pdf),
                        triple(s.weight), s.valid ? "" : ", below the surface");
  }
  if (v.survival < 1) text += fmt::format("   roulette   survives with {:.9g}\n", v.survival);
  text += fmt::format("   sum        {}\n", triple(v.radiance));
  if (v.end) text += fmt::format("   ends       {}\n", end_text(*v.end));
  return text;
}

}  // namespace

std::string path_text(const Scene& scene, const RenderScene& compiled, const SampleName& name,
                      const PathRecord& path) {
  std::string text = fmt::format("pixel {},{} sample {} of seed {}, kernel {}\n", name.x, name.y,
                                 name.sample, scene.render.seed, kernel_name(compiled.kernel));
  for (std::size_t i = 0; i < path.vertices.size(); ++i) {
    text += vertex_text(scene, compiled, i + 1, path.vertices[i]);
  }
  text += fmt::format("radiance      ({:.17g} {:.17g} {:.17g})\n", path.radiance.x, path.radiance.y,
                      path.radiance.z);
  text += path.fault ? fmt::format("dropped       {}\n", fault_name(*path.fault))
                     : fmt::format("film          adds ({} {} {}) steps of {:.9g}\n", path.film.r,
                                   path.film.g, path.film.b,
                                   compiled.film_unit / static_cast<double>(1U << kFilmBits));
  return text;
}

}  // namespace lightbench
