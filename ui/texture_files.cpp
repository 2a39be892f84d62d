#include "ui/texture_files.h"

#include <algorithm>
#include <utility>

#include "ui/scene_edit.h"

namespace lightbench::ui {

void load_texture_image(Workbench& bench, const std::string& texture, const std::string& file,
                        bool srgb) {
  load_image_later(
      bench, file, srgb,
      [&bench, texture, file, srgb](Scene& scene, std::shared_ptr<const Texels> image) {
        std::string name = texture;
        if (name.empty()) {
          bench.editor.selection = add_texture(scene, TextureKind::Image);
          name = item_name(scene, bench.editor.selection);
        }
        // By name: the list may have changed while the file was read.
        const auto target = std::find_if(scene.textures.begin(), scene.textures.end(),
                                         [&](const Texture& t) { return t.name == name; });
        if (target == scene.textures.end()) return;
        target->kind = TextureKind::Image;
        target->file = file;
        target->srgb = srgb;
        target->image = std::move(image);
      });
}

void ask_for_texture_image(Workbench& bench, const std::string& texture) {
  FileQuestion question;
  question.title = "Open image";
  question.start = bench.editor.directory();
  question.extensions = {".png", ".jpg", ".jpeg", ".hdr", ".exr", ".pfm", ".ppm"};
  question.chosen = [&bench, texture](const std::filesystem::path& file) {
    load_texture_image(bench, texture, asset_name(bench.editor, file), true);
  };
  bench.file_dialog.ask(std::move(question));
}

}  // namespace lightbench::ui
