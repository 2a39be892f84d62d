#include "ui/workbench.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <system_error>
#include <utility>

#include "core/scene/scene_io.h"

namespace lightbench::ui {

Workbench::Workbench(Scene scene, std::filesystem::path file, std::function<void()> wake)
    : editor(std::move(scene), std::move(file)),
      jobs(std::move(wake), [this](const std::string& message) {
        notice = {message, true};
      }) {}

double length_step(const Scene& scene) {
  const double distance = glm::length(scene.camera.look_at - scene.camera.look_from);
  return distance > 0 ? std::pow(10.0, std::floor(std::log10(distance))) / 200 : 0.01;
}

void load_image_later(Workbench& bench, const std::string& file, bool srgb,
                      std::function<void(Scene&, std::shared_ptr<const Texels>)> assign) {
  const std::filesystem::path path = bench.editor.directory() / file;
  bench.jobs.run([&bench, path, srgb, assign = std::move(assign)]() -> BackgroundJobs::Finish {
    std::shared_ptr<const Texels> image = load_image(path, srgb);
    return [&bench, assign, image] { assign(bench.editor.scene, image); };
  });
}

std::string asset_name(const Editor& editor, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path relative =
      std::filesystem::proximate(file, std::filesystem::absolute(editor.directory(), error), error);
  return error || relative.empty() ? file.string() : relative.generic_string();
}

}  // namespace lightbench::ui
