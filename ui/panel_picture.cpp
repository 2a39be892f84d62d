#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/query/rays.h"
#include "core/scene/bounds.h"
#include "core/scene/transform.h"
#include "ui/icons.h"
#include "ui/navigation.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/toolbar.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

constexpr double kDegreesPerPixel = 0.3;
constexpr double kWheelStep = 1.12;
constexpr float kLinesPerFont = 14;  // thickness of the outline: a layout unit
constexpr double kNearestFrom = 2;   // zoom from which single pixels are shown as squares

ImVec2 im(const glm::dvec2& v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }
glm::dvec2 glm2(const ImVec2& v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }

/// Size of the picture on show; of the one being edited before the first frame.
glm::dvec2 picture_size(const Workbench& bench) {
  if (bench.frame && bench.frame->scene) {
    return {bench.frame->scene->width, bench.frame->scene->height};
  }
  return {bench.editor.scene.render.width, bench.editor.scene.render.height};
}

void draw_image(const Workbench& bench, const ViewRegion& region) {
  if (!bench.frame || bench.picture.texture() == 0) return;
  const glm::dvec2 size = picture_size(bench);
  Crop crop{0, 0, static_cast<int>(size.x), static_cast<int>(size.y)};
  if (bench.frame->scene && bench.frame->scene->crop.width > 0) crop = bench.frame->scene->crop;
  const int divider = bench.frame->divider;
  // A film pixel of the quick look may reach past the edge of the picture.
  const ImVec2 uv{
      static_cast<float>(crop.width) / static_cast<float>(bench.picture.width() * divider),
      static_cast<float>(crop.height) / static_cast<float>(bench.picture.height() * divider)};
  const ImVec2 min = im(to_screen(bench.view, region, size, {crop.x, crop.y}));
  const ImVec2 max =
      im(to_screen(bench.view, region, size, {crop.x + crop.width, crop.y + crop.height}));
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImGuiPlatformIO& platform = ImGui::GetPlatformIO();
  const bool squares = divider == 1 && effective_zoom(bench.view, region, size) >= kNearestFrom;
  list->AddCallback(
      squares ? platform.DrawCallback_SetSamplerNearest : platform.DrawCallback_SetSamplerFromTex,
      nullptr);
  list->AddImage(ImTextureRef(bench.picture.texture()), min, max, {0, 0}, uv);
  list->AddCallback(platform.DrawCallback_ResetRenderState, nullptr);
}

/// The box of the selected object, drawn over the picture.
void draw_outline(const Workbench& bench, const ViewRegion& region) {
  const Editor& editor = bench.editor;
  if (!bench.outline_shown || editor.selection.kind != ItemKind::Object) return;
  const Object& object = editor.scene.objects[static_cast<std::size_t>(editor.selection.index)];
  const Bounds box =
      shape_bounds(object.shape, glm::dmat4(1), editor.scene.camera, all_mesh_bounds(editor.scene));
  if (box.empty()) return;
  const glm::dmat4 to_world = object_to_world(object.transform);
  const glm::dvec2 size = picture_size(bench);
  std::array<std::optional<glm::dvec2>, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 corner((i & 1U) != 0 ? box.max.x : box.min.x,
                            (i & 2U) != 0 ? box.max.y : box.min.y,
                            (i & 4U) != 0 ? box.max.z : box.min.z);
    corners[i] = project(editor.scene.camera, size, transform_point(to_world, corner));
    if (corners[i]) corners[i] = to_screen(bench.view, region, size, *corners[i]);
  }
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec4& accent = kPalette.accent;
  const ImU32 color = ImGui::GetColorU32(ImVec4(accent.x, accent.y, accent.z, 0.8F));
  const float thickness = std::max(1.0F, ImGui::GetFontSize() / kLinesPerFont);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (const std::size_t bit : {1U, 2U, 4U}) {
      const std::size_t j = i | bit;
      if (j != i && corners[i] && corners[j])
        list->AddLine(im(*corners[i]), im(*corners[j]), color, thickness);
    }
  }
}

/// What lies under a screen position, in the picture on show.
std::optional<Hit> hit_at(const Workbench& bench, const ViewRegion& region,
                          const glm::dvec2& screen) {
  if (!bench.frame || !bench.frame->scene) return std::nullopt;
  const glm::dvec2 size = picture_size(bench);
  const glm::dvec2 pixel = to_picture(bench.view, region, size, screen);
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y) return std::nullopt;
  Scene seen;  // camera_ray needs no more of it than this
  seen.camera = bench.editor.scene.camera;
  seen.render.width = static_cast<int>(size.x);
  seen.render.height = static_cast<int>(size.y);
  return trace(*bench.frame->scene, camera_ray(seen, pixel.x, pixel.y));
}

void click(Workbench& bench, const ViewRegion& region, const glm::dvec2& screen) {
  const std::optional<Hit> hit = hit_at(bench, region, screen);
  const ImGuiIO& io = ImGui::GetIO();
  Camera& camera = bench.editor.scene.camera;
  if (io.KeyShift) {
    if (hit) camera = focus_on(camera, hit->position);
  } else if (io.KeyCtrl) {
    bench.pivot = hit ? std::optional(hit->position) : std::nullopt;
  } else if (hit && hit->object < static_cast<int>(bench.editor.scene.objects.size())) {
    bench.editor.selection = {ItemKind::Object, hit->object};
  } else {
    bench.editor.selection = {};
  }
}

void fly_with_keys(Workbench& bench) {
  const auto axis = [](ImGuiKey plus, ImGuiKey minus) {
    return (ImGui::IsKeyDown(plus) ? 1.0 : 0.0) - (ImGui::IsKeyDown(minus) ? 1.0 : 0.0);
  };
  const glm::dvec3 direction(axis(ImGuiKey_D, ImGuiKey_A), axis(ImGuiKey_E, ImGuiKey_Q),
                             axis(ImGuiKey_W, ImGuiKey_S));
  if (direction == glm::dvec3(0)) return;
  const ImGuiIO& io = ImGui::GetIO();
  const double speed = 120 * length_step(bench.editor.scene) * bench.fly_speed *
                       (io.KeyShift ? 4 : 1) * static_cast<double>(std::min(io.DeltaTime, 0.1F));
  bench.editor.scene.camera = fly(bench.editor.scene.camera, speed * direction);
}

void drag(Workbench& bench, const ViewRegion& region) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 delta = glm2(io.MouseDelta);
  Camera& camera = bench.editor.scene.camera;
  const glm::dvec3 pivot = bench.pivot.value_or(camera.look_at);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
    camera = look(camera, -kDegreesPerPixel * delta.x, -kDegreesPerPixel * delta.y);
    fly_with_keys(bench);
  } else if (ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
    if (io.KeyCtrl) {
      bench.view = pan_by(bench.view, region, picture_size(bench), delta);
    } else {
      const double height =
          effective_zoom(bench.view, region, picture_size(bench)) * picture_size(bench).y;
      camera = pan(camera, delta / height, glm::length(pivot - camera.look_from));
    }
  } else if (ImGui::IsMouseDragging(ImGuiMouseButton_Left) && !io.KeyCtrl && !io.KeyShift) {
    camera = orbit(camera, pivot, -kDegreesPerPixel * delta.x, -kDegreesPerPixel * delta.y);
  }
}

void wheel(Workbench& bench, const ViewRegion& region) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto turn = static_cast<double>(io.MouseWheel);
  if (turn == 0) return;
  bench.wheel_time = ImGui::GetTime();
  Camera& camera = bench.editor.scene.camera;
  if (io.KeyCtrl) {
    bench.view = zoom_at(bench.view, region, picture_size(bench), glm2(io.MousePos),
                         std::pow(kWheelStep, turn));
  } else if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
    bench.fly_speed = std::clamp(bench.fly_speed * std::pow(1.25, turn), 1e-3, 1e3);
  } else {
    camera = dolly(camera, bench.pivot.value_or(camera.look_at), std::pow(kWheelStep, -turn));
  }
}

void handle_mouse(Workbench& bench, const ViewRegion& region) {
  ImGui::InvisibleButton("##picture", im(region.size),
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                             ImGuiButtonFlags_MouseButtonRight);
  note_widget("View");
  const ImGuiIO& io = ImGui::GetIO();
  bench.navigating = ImGui::IsItemActive();
  if (ImGui::IsItemActive()) drag(bench, region);
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) wheel(bench, region);
  const float threshold = io.MouseDragThreshold * io.MouseDragThreshold;
  if (ImGui::IsItemDeactivated() && io.MouseReleased[ImGuiMouseButton_Left] &&
      io.MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < threshold) {
    click(bench, region, glm2(io.MousePos));
  }
}

/// What went wrong, across the top of the picture until it is closed.
void draw_notice(Workbench& bench) {
  if (bench.notice.text.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, ImVec4(0.2F, 0.2F, 0.2F, 1));
  if (ImGui::BeginChild("notice", {0, 0},
                        ImGuiChildFlags_AlwaysUseWindowPadding | ImGuiChildFlags_AutoResizeY)) {
    ImGui::AlignTextToFramePadding();
    if (bench.notice.error) {
      ImGui::TextColored(kPalette.error, "%s", icon::kWarning);
      ImGui::SameLine();
    }
    const float close = 2 * ImGui::GetFrameHeight();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - close);
    ImGui::TextUnformatted(bench.notice.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::SameLine(ImGui::GetWindowWidth() - close);
    if (ImGui::SmallButton((std::string(icon::kClose) + "##close").c_str())) bench.notice = {};
    note_widget("Close notice");
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
}

}  // namespace

void draw_picture_panel(Workbench& bench) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, kPalette.surround);
  const char* title = panel::kPicture;
  ImGuiWindowFlags flags = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  if (!bench.panels_shown) {
    // Another window than the docked one, whose place in the layout is kept.
    title = "Picture only";
    flags |= ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoMove |
             ImGuiWindowFlags_NoSavedSettings;
    const ImGuiViewport* viewport = ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport->WorkPos);
    ImGui::SetNextWindowSize(viewport->WorkSize);
  }
  const bool open = ImGui::Begin(title, nullptr, flags);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  if (open) {
    if (bench.panels_shown) draw_toolbar(bench);
    draw_notice(bench);
    const ImVec2 available = ImGui::GetContentRegionAvail();
    const ViewRegion region{glm2(ImGui::GetCursorScreenPos()),
                            glm::max(glm2(available), glm::dvec2(1))};
    handle_mouse(bench, region);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->PushClipRect(im(region.min), im(region.min + region.size), true);
    draw_image(bench, region);
    draw_outline(bench, region);
    list->PopClipRect();
    bench.shown_zoom = effective_zoom(bench.view, region, picture_size(bench));
  }
  ImGui::End();
}

}  // namespace lightbench::ui
