#include "ui/theme.h"

#include <lightbench_fonts.h>

namespace lightbench::ui {
namespace {

ImVec4 grey(float value, float alpha = 1) { return {value, value, value, alpha}; }

ImVec4 accent(float alpha) {
  const ImVec4& a = kPalette.accent;
  return {a.x, a.y, a.z, alpha};
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = kPalette.text;
  c[ImGuiCol_TextDisabled] = grey(0.45F);
  c[ImGuiCol_WindowBg] = grey(0.15F);
  c[ImGuiCol_ChildBg] = grey(0, 0);
  c[ImGuiCol_PopupBg] = grey(0.18F, 0.99F);
  c[ImGuiCol_Border] = grey(0.07F);
  c[ImGuiCol_BorderShadow] = grey(0, 0);
  c[ImGuiCol_FrameBg] = grey(0.205F);
  c[ImGuiCol_FrameBgHovered] = grey(0.245F);
  c[ImGuiCol_FrameBgActive] = grey(0.28F);
  c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(0.105F);
  c[ImGuiCol_MenuBarBg] = grey(0.105F);
  c[ImGuiCol_ScrollbarBg] = grey(0, 0);
  c[ImGuiCol_ScrollbarGrab] = grey(0.28F);
  c[ImGuiCol_ScrollbarGrabHovered] = grey(0.35F);
  c[ImGuiCol_ScrollbarGrabActive] = grey(0.42F);
  c[ImGuiCol_CheckMark] = kPalette.accent;
  c[ImGuiCol_CheckboxSelectedBg] = grey(0.205F);
  c[ImGuiCol_SliderGrab] = accent(0.85F);
  c[ImGuiCol_SliderGrabActive] = kPalette.accent;
  c[ImGuiCol_Button] = grey(0.23F);
  c[ImGuiCol_ButtonHovered] = grey(0.29F);
  c[ImGuiCol_ButtonActive] = grey(0.34F);
  c[ImGuiCol_Header] = grey(0.195F);
  c[ImGuiCol_HeaderHovered] = grey(0.245F);
  c[ImGuiCol_HeaderActive] = grey(0.28F);
  c[ImGuiCol_Separator] = grey(0.085F);
  c[ImGuiCol_SeparatorHovered] = accent(0.5F);
  c[ImGuiCol_SeparatorActive] = kPalette.accent;
  c[ImGuiCol_ResizeGrip] = grey(0, 0);
  c[ImGuiCol_ResizeGripHovered] = accent(0.5F);
  c[ImGuiCol_ResizeGripActive] = kPalette.accent;
  c[ImGuiCol_InputTextCursor] = kPalette.text;
  c[ImGuiCol_Tab] = c[ImGuiCol_TabDimmed] = grey(0.105F);
  c[ImGuiCol_TabHovered] = grey(0.2F);
  c[ImGuiCol_TabSelected] = c[ImGuiCol_TabDimmedSelected] = grey(0.15F);
  c[ImGuiCol_TabSelectedOverline] = kPalette.accent;
  c[ImGuiCol_TabDimmedSelectedOverline] = grey(0.4F);
  c[ImGuiCol_DockingPreview] = accent(0.4F);
  c[ImGuiCol_DockingEmptyBg] = kPalette.surround;
  c[ImGuiCol_PlotLines] = c[ImGuiCol_PlotHistogram] = kPalette.accent;
  c[ImGuiCol_PlotLinesHovered] = c[ImGuiCol_PlotHistogramHovered] = kPalette.accent;
  c[ImGuiCol_TableHeaderBg] = grey(0.18F);
  c[ImGuiCol_TableBorderStrong] = grey(0.085F);
  c[ImGuiCol_TableBorderLight] = grey(0.12F);
  c[ImGuiCol_TextLink] = kPalette.accent;
  c[ImGuiCol_TextSelectedBg] = accent(0.35F);
  c[ImGuiCol_DragDropTarget] = kPalette.accent;
  c[ImGuiCol_UnsavedMarker] = kPalette.accent;
  c[ImGuiCol_NavCursor] = accent(0.8F);
  c[ImGuiCol_ModalWindowDimBg] = grey(0, 0.5F);
}

}  // namespace

void load_fonts() {
  ImFontAtlas* atlas = ImGui::GetIO().Fonts;
  ImFontConfig text;
  text.FontDataOwnedByAtlas = false;
  // ImGui takes a mutable pointer but leaves data that it does not own alone.
  const auto add = [&](const unsigned char* data, std::size_t size, const ImFontConfig& config) {
    atlas->AddFontFromMemoryTTF(const_cast<unsigned char*>(data), static_cast<int>(size), kFontSize,
                                &config);
  };
  add(font_inter_ttf, font_inter_ttf_size, text);
  ImFontConfig icons;
  icons.FontDataOwnedByAtlas = false;
  icons.MergeMode = true;
  icons.GlyphMinAdvanceX = kFontSize;
  atlas->AddFontFromMemoryTTF(const_cast<unsigned char*>(font_icons_ttf),
                              static_cast<int>(font_icons_ttf_size), 0.75F * kFontSize, &icons);
}

void apply_theme(float scale) {
  ImGuiStyle style;
  set_colors(style);
  style.FontSizeBase = kFontSize;
  style.FontScaleDpi = scale;
  style.WindowPadding = {10, 8};
  style.FramePadding = {7, 4};
  style.ItemSpacing = {7, 5};
  style.ItemInnerSpacing = {4, 4};
  style.CellPadding = {6, 3};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 10;
  style.GrabMinSize = 8;
  style.WindowBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.TabBorderSize = 0;
  style.TabBarBorderSize = 0;
  style.TabBarOverlineSize = 2;
  style.DockingSeparatorSize = 2;
  style.WindowRounding = 4;
  style.ChildRounding = 3;
  style.PopupRounding = 4;
  style.FrameRounding = 3;
  style.GrabRounding = 2;
  style.TabRounding = 0;
  style.ScrollbarRounding = 5;
  style.ColorMarkerSize = 0;
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.ColorButtonPosition = ImGuiDir_Left;
  style.SelectableTextAlign = {0, 0.5F};
  style.DisabledAlpha = 0.4F;
  style.ScaleAllSizes(scale);
  // ImGui keeps the size in use by a running frame here; a fresh style has lost it.
  style._NextFrameFontSizeBase = kFontSize;
  ImGui::GetStyle() = style;
}

}  // namespace lightbench::ui
