#include "ui/item_list.h"

#include <cstdio>

#include "core/scene/scene_io.h"
#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/scene_edit.h"
#include "ui/texture_files.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void select(Workbench& bench, Selection selection) { bench.editor.selection = selection; }

void context_menu(Workbench& bench, Selection item) {
  if (!ImGui::BeginPopupContextItem()) return;
  select(bench, item);
  if (ImGui::MenuItem("Duplicate", shortcut_keys(Action::Duplicate))) {
    bench.request(Action::Duplicate);
  }
  note_widget("Duplicate");
  if (item.kind == ItemKind::Object &&
      ImGui::MenuItem("Frame", shortcut_keys(Action::FrameSelection))) {
    bench.request(Action::FrameSelection);
  }
  if (ImGui::MenuItem("Delete", shortcut_keys(Action::Delete))) bench.request(Action::Delete);
  note_widget("Delete");
  ImGui::EndPopup();
}

void add_mesh_from_file(Workbench& bench, const std::filesystem::path& file) {
  const std::string stored = asset_name(bench.editor, file);
  bench.jobs.run([&bench, file, stored]() -> BackgroundJobs::Finish {
    std::shared_ptr<const Mesh> mesh = load_mesh(file);
    return [&bench, stored, mesh = std::move(mesh)] {
      const std::string name = std::filesystem::path(stored).stem().string();
      select(bench, add_mesh(bench.editor.scene, name, stored, mesh));
    };
  });
}

void ask_for_mesh(Workbench& bench) {
  FileQuestion question;
  question.title = "Add mesh";
  question.start = bench.editor.directory();
  question.extensions = {".ply", ".obj", ".stl", ".gltf", ".glb"};
  question.chosen = [&bench](const std::filesystem::path& file) {
    add_mesh_from_file(bench, file);
  };
  bench.file_dialog.ask(std::move(question));
}

}  // namespace

void draw_item_row(Workbench& bench, Selection item, const char* icon, const ImVec4* swatch,
                   bool dimmed, float trailing) {
  std::string name = item_name(bench.editor.scene, item);
  if (name.empty() && item.kind == ItemKind::Object) {
    const auto index = static_cast<std::size_t>(item.index);
    name = shape_names()[bench.editor.scene.objects[index].shape.index()];
  }
  ImGui::PushID(item.index);
  const bool selected = bench.editor.selection == item;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  const float width = ImGui::GetContentRegionAvail().x - trailing;
  if (selected) {
    const ImVec4& accent = kPalette.accent;
    ImGui::PushStyleColor(ImGuiCol_Header, ImVec4(accent.x, accent.y, accent.z, 0.25F));
  }
  // Rows touch, and their highlight is as wide in every list.
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  if (ImGui::Selectable("##row", selected, ImGuiSelectableFlags_None, {width, height})) {
    select(bench, item);
  }
  ImGui::PopStyleVar();
  note_widget(name.c_str());
  if (selected) ImGui::PopStyleColor();
  context_menu(bench, item);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0) && item.kind == ItemKind::Object) {
    bench.request(Action::FrameSelection);
  }
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float em = ImGui::GetFontSize();
  const float middle = start.y + 0.5F * height;
  const float left = start.x + 0.3F * em;
  if (swatch != nullptr) {
    list->AddRectFilled({left, middle - 0.4F * em}, {left + 0.8F * em, middle + 0.4F * em},
                        ImGui::GetColorU32(*swatch), 2);
  } else {
    list->AddText({left, middle - 0.5F * em},
                  ImGui::GetColorU32(selected ? kPalette.accent : kPalette.muted), icon);
  }
  const ImVec2 text{start.x + 1.7F * em, middle - 0.5F * em};
  list->PushClipRect(start, {start.x + width, start.y + height}, true);
  list->AddText(text, ImGui::GetColorU32(dimmed ? ImGuiCol_TextDisabled : ImGuiCol_Text),
                elided(name, start.x + width - text.x).c_str());
  list->PopClipRect();
  ImGui::PopID();
}

void add_object_menu(Workbench& bench) {
  const std::vector<const char*>& names = shape_names();
  for (std::size_t shape = 0; shape + 1 < names.size(); ++shape) {
    if (ImGui::MenuItem(names[shape])) select(bench, add_object(bench.editor.scene, shape));
    note_widget(names[shape]);
  }
  if (ImGui::MenuItem("Mesh...")) ask_for_mesh(bench);
  note_widget("Mesh...");
}

void add_material_menu(Workbench& bench) {
  constexpr const char* kNames[] = {"Matte", "Metal", "Glass", "Light"};
  for (int kind = 0; kind < 4; ++kind) {
    if (ImGui::MenuItem(kNames[kind])) {
      select(bench, add_material(bench.editor.scene, static_cast<MaterialKind>(kind)));
    }
    note_widget(kNames[kind]);
  }
}

void add_texture_menu(Workbench& bench) {
  constexpr const char* kNames[] = {"Colour", "Image...",   "Checker",
                                    "Noise",  "Turbulence", "Marble"};
  for (int kind = 0; kind < 6; ++kind) {
    if (ImGui::MenuItem(kNames[kind])) {
      if (static_cast<TextureKind>(kind) == TextureKind::Image) {
        ask_for_texture_image(bench, "");
      } else {
        select(bench, add_texture(bench.editor.scene, static_cast<TextureKind>(kind)));
      }
    }
    note_widget(kNames[kind]);
  }
}

void add_light(Workbench& bench) { select(bench, add_light(bench.editor.scene)); }
void add_medium(Workbench& bench) { select(bench, add_medium(bench.editor.scene)); }

bool list_header(const char* title, int count, const char* add_label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  ImGui::SameLine();
  ImGui::TextColored(kPalette.muted, "%d", count);
  const float button = 1.35F * ImGui::GetFrameHeight();
  ImGui::SameLine(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - button);
  return icon_button(icon::kAdd, add_label);
}

}  // namespace lightbench::ui
