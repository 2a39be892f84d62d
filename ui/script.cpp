#include "ui/script.h"

#include <imgui.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/film/image_file.h"
#include "core/film/tone_map.h"
#include "core/scene/scene_io.h"
#include "ui/scene_edit.h"
#include "ui/script_input.h"

namespace lightbench::ui {
namespace {

using nlohmann::json;
using std::string;

constexpr double kFrameSeconds = 1.0 / 60;
constexpr int kLongestWait = 36000;  // frames for which a widget or a job may be awaited

/// What a step may use.
struct Script {
  Application& application;
  const GlContext& gl;
};

void select_by_name(Script& script, const string& name) {
  Editor& editor = script.application.bench().editor;
  for (const ItemKind kind :
       {ItemKind::Object, ItemKind::Material, ItemKind::Texture, ItemKind::Medium}) {
    for (int i = 0; i < item_count(editor.scene, kind); ++i) {
      if (item_name(editor.scene, {kind, i}) == name) {
        editor.selection = {kind, i};
        return;
      }
    }
  }
  throw Error(ErrorKind::Usage, "nothing in the scene is named \"" + name + "\"");
}

void set_value(Script& script, const json& step) {
  Editor& editor = script.application.bench().editor;
  const Selection selection = editor.selection;
  editor.scene = parse_scene(scene_to_json(editor.scene, editor.directory()), editor.directory(),
                             "script", {{step.at("set"), step.at("value").dump()}});
  editor.selection = is_valid(editor.scene, selection) ? selection : Selection{};
}

void write_widgets(Script& script, const std::filesystem::path& file) {
  json list = json::object();
  for (const auto& [name, place] : script.application.gui().widgets().places) {
    if (!place.visible) continue;
    list[name] = {place.min.x, place.min.y, place.max.x, place.max.y};
  }
  std::ofstream stream(file);
  stream << list.dump(1) << '\n';
  if (!stream.flush()) throw Error(ErrorKind::Output, "cannot write " + file.string());
}

void finish_jobs(Script& script) {
  for (int i = 0; script.application.bench().jobs.pending() > 0; ++i) {
    if (i == kLongestWait) throw Error(ErrorKind::Output, "files are still being written");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    step_frame(script.application);
  }
}

void check_notice(Script& script, const string& expected) {
  const Notice& notice = script.application.bench().notice;
  if (notice.text.find(expected) == string::npos || notice.text.empty()) {
    throw Error(ErrorKind::Usage,
                "expected a notice with \"" + expected + "\", got \"" + notice.text + "\"");
  }
}

using Step = void (*)(Script&, const json&);

/// Every step by the key that names it.
const std::map<string, Step>& steps_by_name() {
  static const std::map<string, Step> table{
      {"click", [](Script& s, const json& j) { click_widget(s.application, j); }},
      {"drag", [](Script& s, const json& j) { drag_widget(s.application, j); }},
      {"wheel", [](Script& s, const json& j) { turn_wheel(s.application, j); }},
      {"type", [](Script& s, const json& j) { type_text(s.application, j.at("type")); }},
      {"key", [](Script& s, const json& j) { press_key(s.application, j.at("key")); }},
      {"select", [](Script& s, const json& j) { select_by_name(s, j.at("select")); }},
      {"show",
       [](Script& s, const json& j) {
         step_frame(s.application);
         ImGui::SetWindowFocus(j.at("show").get<string>().c_str());
       }},
      {"set", [](Script& s, const json& j) { set_value(s, j); }},
      {"wait_spp",
       [](Script& s, const json& j) {
         wait_for_samples(s.application, j.at("wait_spp").get<std::uint32_t>());
       }},
      {"wait_files", [](Script& s, const json&) { finish_jobs(s); }},
      {"frames",
       [](Script& s, const json& j) {
         for (int i = 0; i < j.at("frames").get<int>(); ++i) step_frame(s.application);
       }},
      {"screenshot",
       [](Script& s, const json& j) { write_screenshot(s.gl, j.at("screenshot").get<string>()); }},
      {"widgets",
       [](Script& s, const json& j) { write_widgets(s, j.at("widgets").get<string>()); }},
      {"save",
       [](Script& s, const json& j) {
         save_scene(s.application.bench().editor.scene, j.at("save").get<string>());
       }},
      {"expect_notice", [](Script& s, const json& j) { check_notice(s, j.at("expect_notice")); }},
  };
  return table;
}

void run_step(Script& script, const json& step) {
  if (!step.is_object()) throw Error(ErrorKind::Usage, "expected an object");
  for (const auto& [name, run] : steps_by_name()) {
    if (!step.contains(name)) continue;
    run(script, step);
    // ImGui needs a frame to see what happened and one to lay it out.
    for (int i = 0; i < 3; ++i) step_frame(script.application);
    return;
  }
  string known;
  for (const auto& [name, run] : steps_by_name()) known += (known.empty() ? "" : ", ") + name;
  throw Error(ErrorKind::Usage, "no known step; expected one of " + known);
}

}  // namespace

void step_frame(Application& application) { application.frame(kFrameSeconds); }

void wait_for_samples(Application& application, std::uint32_t spp,
                      const std::function<void(std::uint32_t)>& report) {
  // Drawing takes from the renderer what it needs itself, so frames are few.
  auto pause = std::chrono::milliseconds(5);
  for (;;) {
    step_frame(application);
    const Workbench& bench = application.bench();
    const std::shared_ptr<const Frame>& frame = bench.frame;
    if (bench.status.state == SessionState::Failed) {
      throw Error(ErrorKind::Scene, bench.status.error);
    }
    // The quick look of a new scene has too few pixels to count.
    const bool current =
        frame && frame->generation >= application.generation() && frame->divider == 1;
    if (current && frame->spp >= spp) return;
    if (current && bench.status.state == SessionState::Finished && frame->spp >= bench.status.spp) {
      return;
    }
    if (report) report(current ? frame->spp : 0);
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(250));
  }
}

void write_screenshot(const GlContext& gl, const std::filesystem::path& file) {
  const std::vector<std::uint8_t> rgb = gl.read_rgb();
  Image image;
  image.width = gl.width();
  image.height = gl.height();
  image.rgb.reserve(rgb.size());
  // Through linear values and back: exact, since every 8-bit value survives the round trip.
  for (const std::uint8_t value : rgb) {
    image.rgb.push_back(linear_from_srgb(static_cast<float>(value) / 255));
  }
  write_image(file, image, Display{}, {{"Software", "Lightbench"}});
}

void run_script(Application& application, const GlContext& gl, const json& steps) {
  if (!steps.is_array()) throw Error(ErrorKind::Usage, "script: expected an array of steps");
  Script script{application, gl};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    try {
      run_step(script, steps[i]);
    } catch (const Error& error) {
      throw Error(error.kind(),
                  "script: /" + std::to_string(i) + " " + steps[i].dump() + ": " + error.what());
    } catch (const json::exception& error) {
      throw Error(ErrorKind::Usage,
                  "script: /" + std::to_string(i) + " " + steps[i].dump() + ": " + error.what());
    }
  }
}

}  // namespace lightbench::ui
