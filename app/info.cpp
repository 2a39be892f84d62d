// lightbench info: what a scene holds and how it would be rendered.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/scene_options.h"
#include "core/compile/render_scene.h"
#include "core/format.h"

namespace lightbench {
namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  SceneOptions scene;
  bool json = false;
};

constexpr std::array<const char*, std::variant_size_v<Shape>> kShapeNames = {
    "sphere", "cylinder", "disc", "rectangle", "triangle", "pyramid", "box", "mesh"};

/// Things that are allowed but rarely meant.
std::vector<std::string> warnings(const Scene& scene, const RenderStats& stats) {
  std::vector<std::string> found;
  const Environment& environment = scene.environment;
  const bool dark_color =
      environment.color == glm::dvec3(0) &&
      (environment.kind != EnvironmentKind::Gradient || environment.horizon == glm::dvec3(0));
  if (stats.lights == 0 && (dark_color || environment.strength == 0)) {
    found.push_back("nothing gives light: the picture will be black");
  }
  std::vector<bool> material_used(scene.materials.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const std::string where = fmt::format("/objects/{} ({})", i, object.name);
    if (object.material != kNone) material_used[static_cast<std::size_t>(object.material)] = true;
    if (!object.visible) found.push_back(where + " is hidden");
    if (object.material == kNone && object.medium == kNone) {
      found.push_back(where + " has neither material nor medium and will not be seen");
    }
  }
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::string where = fmt::format("/materials/{} ({})", i, scene.materials[i].name);
    if (!material_used[i]) found.push_back(where + " is not used");
    if (scene.materials[i].kind == MaterialKind::Emissive && !emits(scene.materials[i])) {
      found.push_back(where + " is emissive but emits nothing");
    }
  }
  return found;
}

Json triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json describe(const SceneOptions& options) {
  const KernelKind kernel = chosen_kernel(options);
  const Scene scene = load_scene(options);
  const auto compiled = compile(scene, kernel);
  const RenderStats& stats = compiled->stats;
  Json shapes = Json::object();
  for (const Object& object : scene.objects) {
    Json& count = shapes[kShapeNames[object.shape.index()]];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  Json features = Json::array();
  for (const FeatureUse& feature : stats.features) {
    features.push_back({{"name", feature.name}, {"used", feature.used}, {"note", feature.note}});
  }
  const Camera& camera = scene.camera;
  const RenderSettings& render = scene.render;
  return {
      {"scene", options.file},
      {"resolution", {render.width, render.height}},
      {"film", {compiled->crop.width, compiled->crop.height}},
      {"spp", render.spp},
      {"maxDepth", render.max_depth},
      {"seed", render.seed},
      {"camera",
       {{"lookFrom", triple(camera.look_from)},
        {"lookAt", triple(camera.look_at)},
        {"vfov", camera.vfov},
        {"focalLength", focal_length(camera)},
        {"lensRadius", camera.lens_radius},
        {"focusDistance", camera.focus_distance},
        {"shutter", {camera.shutter_open, camera.shutter_close}}}},
      {"objects", stats.objects},
      {"shapes", shapes},
      {"primitives", stats.primitives},
      {"triangles", stats.triangles},
      {"lights", stats.lights},
      {"materials", scene.materials.size()},
      {"textures", scene.textures.size()},
      {"media", scene.media.size()},
      {"sceneBytes", stats.bytes},
      {"filmBytes", std::int64_t{compiled->crop.width} * compiled->crop.height *
                        static_cast<std::int64_t>(sizeof(FilmPixel))},
      {"compileSeconds", stats.compile_seconds},
      {"kernel", kernel_name(compiled->kernel)},
      {"range", stats.range},
      {"smallestObject", stats.smallest_object},
      {"precision", stats.precision == Precision::Float ? "float" : "double"},
      {"precisionReason", stats.precision_reason},
      {"features", features},
      {"warnings", warnings(scene, stats)},
  };
}

std::string number(const Json& value) { return fmt::format("{}", value.get<double>()); }

std::string point(const Json& v) {
  return fmt::format("({} {} {})", number(v[0]), number(v[1]), number(v[2]));
}

void print_text(const Json& info) {
  const auto row = [](const char* label, const std::string& text) {
    fmt::print("{:<12}{}\n", label, text);
  };
  std::string shapes;
  for (const auto& [name, count] : info["shapes"].items()) {
    shapes += fmt::format("{}{} {}", shapes.empty() ? "" : ", ", count.get<int>(), name);
  }
  std::string used, skipped;
  for (const Json& feature : info["features"]) {
    std::string& list = feature["used"].get<bool>() ? used : skipped;
    const auto note = feature["note"].get<std::string>();
    list += fmt::format("{}{}{}", list.empty() ? "" : ", ", feature["name"].get<std::string>(),
                        note.empty() ? "" : " (" + note + ")");
  }
  const Json& camera = info["camera"];
  const auto radius = camera["lensRadius"].get<double>();
  row("scene", info["scene"].get<std::string>());
  row("picture", fmt::format("{}x{}, {} spp, depth {}, seed {}", info["resolution"][0].get<int>(),
                             info["resolution"][1].get<int>(), info["spp"].get<int>(),
                             info["maxDepth"].get<int>(), info["seed"].get<std::uint32_t>()));
  row("camera", fmt::format("from {} at {}, vfov {} deg ({:.1f} mm), {}, shutter {}..{}",
                            point(camera["lookFrom"]), point(camera["lookAt"]),
                            number(camera["vfov"]), camera["focalLength"].get<double>(),
                            radius > 0 ? fmt::format("lens radius {} focused at {}", radius,
                                                     number(camera["focusDistance"]))
                                       : "pinhole",
                            number(camera["shutter"][0]), number(camera["shutter"][1])));
  row("objects", fmt::format("{}{}", info["objects"].get<std::int64_t>(),
                             shapes.empty() ? "" : " (" + shapes + ")"));
  row("primitives",
      fmt::format("{}, of them {} triangles in meshes", info["primitives"].get<std::int64_t>(),
                  info["triangles"].get<std::int64_t>()));
  row("lights", fmt::format("{}", info["lights"].get<std::int64_t>()));
  row("appearance", fmt::format("{} materials, {} textures, {} media", info["materials"].get<int>(),
                                info["textures"].get<int>(), info["media"].get<int>()));
  row("memory",
      fmt::format("scene {}, film {}", format_bytes(info["sceneBytes"].get<std::uint64_t>()),
                  format_bytes(info["filmBytes"].get<std::uint64_t>())));
  row("kernel", fmt::format("{}, compiled in {:.2f} ms", info["kernel"].get<std::string>(),
                            1000 * info["compileSeconds"].get<double>()));
  row("precision",
      info["precision"].get<std::string>() + ": " + info["precisionReason"].get<std::string>());
  row("used", used.empty() ? "nothing" : used);
  row("skipped", skipped.empty() ? "nothing" : skipped);
  for (const Json& warning : info["warnings"]) row("warning", warning.get<std::string>());
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App& command = *app.add_subcommand("info", "Say what a scene holds and what it needs");
  add_scene_options(command, options->scene, SceneArgument::Required);
  command.add_flag("--json", options->json, "Print JSON");
  command.callback([options, &action] {
    action = [options] {
      const Json info = describe(options->scene);
      if (options->json) {
        fmt::print("{}\n", info.dump(2));
      } else {
        print_text(info);
      }
      return 0;
    };
  });
}

}  // namespace lightbench
