#include "ui/fields.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdint>

#include "core/film/tone_map.h"
#include "core/scene/scene.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

constexpr float kLabelShare = 0.38F;
constexpr float kColorWidth = 11;  // em

/// Draws the label and sets the next widget to fill the row; returns the hidden ImGui label.
std::string begin_row(const char* label) {
  const float left = ImGui::GetCursorPosX();
  // A label longer than its column pushes the widget aside rather than run under it.
  const float column = std::max(kLabelShare * ImGui::GetContentRegionAvail().x,
                                ImGui::CalcTextSize(label).x + ImGui::GetStyle().ItemSpacing.x);
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, kPalette.muted);
  ImGui::TextUnformatted(label);
  ImGui::PopStyleColor();
  ImGui::SameLine(left + column);
  ImGui::SetNextItemWidth(-FLT_MIN);
  return std::string("##") + label;
}

void end_row(const char* label, const char* tip) {
  note_widget(label);
  tip_for_last(tip);
}

ImGuiSliderFlags flags_of(const NumberStyle& style) {
  return ImGuiSliderFlags_AlwaysClamp |
         (style.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
}

}  // namespace

bool number_field(const char* label, double& value, const NumberStyle& style) {
  const std::string id = begin_row(label);
  const bool changed =
      ImGui::DragScalar(id.c_str(), ImGuiDataType_Double, &value, static_cast<float>(style.speed),
                        &style.min, &style.max, style.format, flags_of(style));
  end_row(label, style.tip);
  return changed;
}

bool slider_field(const char* label, double& value, const NumberStyle& style) {
  const std::string id = begin_row(label);
  const bool changed = ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &style.min,
                                           &style.max, style.format, flags_of(style));
  end_row(label, style.tip);
  return changed;
}

bool integer_field(const char* label, int& value, int min, int max, const char* format,
                   const char* tip) {
  const std::string id = begin_row(label);
  const float speed = std::max(0.05F, 0.005F * static_cast<float>(value));
  const bool changed =
      ImGui::DragInt(id.c_str(), &value, speed, min, max, format, ImGuiSliderFlags_AlwaysClamp);
  end_row(label, tip);
  return changed;
}

bool seed_field(const char* label, std::uint32_t& value) {
  const std::string id = begin_row(label);
  const bool changed = ImGui::DragScalar(id.c_str(), ImGuiDataType_U32, &value, 0.1F);
  end_row(label, "Another seed, another pattern of noise");
  return changed;
}

bool vector_field(const char* label, glm::dvec3& value, const NumberStyle& style) {
  const std::string id = begin_row(label);
  const bool changed = ImGui::DragScalarN(id.c_str(), ImGuiDataType_Double, &value.x, 3,
                                          static_cast<float>(style.speed), &style.min, &style.max,
                                          style.format, flags_of(style));
  end_row(label, style.tip);
  return changed;
}

bool color_field(const char* label, glm::dvec3& linear, const char* tip) {
  const std::string id = begin_row(label);
  std::array<float, 3> srgb{};
  for (int c = 0; c < 3; ++c) {
    srgb[static_cast<std::size_t>(c)] = srgb_from_linear(static_cast<float>(linear[c]));
  }
  const std::array<float, 3> before = srgb;
  // Three numbers need room; a narrow panel shows the one that fits.
  const bool narrow = ImGui::GetContentRegionAvail().x < kColorWidth * ImGui::GetFontSize();
  const bool changed = ImGui::ColorEdit3(
      id.c_str(), srgb.data(),
      ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoTooltip |
          ImGuiColorEditFlags_PickerHueWheel |
          (narrow ? ImGuiColorEditFlags_DisplayHex : ImGuiColorEditFlags_DisplayRGB));
  note_widget(label);
  // Channels the user did not touch keep their exact linear value.
  for (int c = 0; c < 3; ++c) {
    const float value = srgb[static_cast<std::size_t>(c)];
    if (changed && value != before[static_cast<std::size_t>(c)]) {
      linear[c] = static_cast<double>(linear_from_srgb(std::clamp(value, 0.0F, 1.0F)));
    }
  }
  if (ImGui::BeginItemTooltip()) {
    if (tip != nullptr) ImGui::TextUnformatted(tip);
    ImGui::TextColored(kPalette.muted, "shown in sRGB; linear %.4g  %.4g  %.4g", linear.x, linear.y,
                       linear.z);
    ImGui::EndTooltip();
  }
  return changed;
}

bool toggle_field(const char* label, bool& value, const char* tip) {
  const std::string id = begin_row(label);
  const bool changed = ImGui::Checkbox(id.c_str(), &value);
  end_row(label, tip);
  return changed;
}

bool choice_field(const char* label, int& index, const std::vector<const char*>& names,
                  const char* tip) {
  const std::string id = begin_row(label);
  const bool changed =
      ImGui::Combo(id.c_str(), &index, names.data(), static_cast<int>(names.size()));
  end_row(label, tip);
  return changed;
}

bool reference_field(const char* label, int& index, const std::vector<std::string>& names,
                     const char* none) {
  const std::string id = begin_row(label);
  const bool known = index >= 0 && index < static_cast<int>(names.size());
  const std::string shown =
      known ? names[static_cast<std::size_t>(index)] : (none != nullptr ? none : "");
  bool changed = false;
  const bool open = ImGui::BeginCombo(id.c_str(), shown.c_str());
  if (!open) {
    note_widget(label);
    return false;
  }
  if (none != nullptr && ImGui::Selectable(none, !known)) {
    changed = index != kNone;
    index = kNone;
  }
  for (int i = 0; i < static_cast<int>(names.size()); ++i) {
    ImGui::PushID(i);
    if (ImGui::Selectable(names[static_cast<std::size_t>(i)].c_str(), i == index)) {
      changed = changed || i != index;
      index = i;
    }
    note_widget(names[static_cast<std::size_t>(i)].c_str());
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return changed;
}

bool text_field(const char* label, std::string& value, const char* hint) {
  begin_row(label);
  return wide_text_field(label, value, hint);
}

bool wide_text_field(const char* label, std::string& value, const char* hint) {
  // ImGui keeps what is being typed; `value` stays as it is until that is done.
  std::string text = value;
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint((std::string("##") + label).c_str(), hint, &text,
                           ImGuiInputTextFlags_AutoSelectAll);
  const bool finished = ImGui::IsItemDeactivatedAfterEdit();
  note_widget(label);
  if (finished) value = text;
  return finished;
}

void value_row(const char* label, const std::string& value) {
  begin_row(label);
  ImGui::TextUnformatted(value.c_str());
  note_widget(label);
}

std::string elided(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::size_t kept = text.size();
  const auto shortened = [&] { return text.substr(0, kept) + "..."; };
  while (kept > 0 && ImGui::CalcTextSize(shortened().c_str()).x > width) {
    // Whole characters only: in UTF-8 all bytes but the first are 10xxxxxx.
    do --kept;
    while (kept > 0 && (static_cast<unsigned char>(text[kept]) & 0xc0U) == 0x80U);
  }
  return shortened();
}

void elided_text(const std::string& text) {
  ImGui::TextUnformatted(elided(text, ImGui::GetContentRegionAvail().x).c_str());
}

void note(const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, kPalette.muted);
  ImGui::TextWrapped("%s", text);
  ImGui::PopStyleColor();
}

bool section(const char* title) {
  const bool open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
  note_widget(title);
  return open;
}

bool icon_button(const char* icon, const char* label, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool clicked = ImGui::Button((std::string(icon) + "###" + label).c_str(),
                                     {1.35F * ImGui::GetFrameHeight(), 0});
  ImGui::EndDisabled();
  note_widget(label);
  tip_for_last(label);
  return clicked;
}

void tip_for_last(const char* tip) {
  if (tip != nullptr) ImGui::SetItemTooltip("%s", tip);
}

}  // namespace lightbench::ui
