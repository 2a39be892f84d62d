// End to end: the program in a real window under Xvfb, used with xdotool as a person would.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/scene/scene_io.h"

namespace lightbench {
namespace {
namespace fs = std::filesystem;

bool wait_until(double seconds, const std::function<bool()>& done) {
#ifdef __SANITIZE_ADDRESS__
  seconds *= 5;  // watched, a pass takes seconds
#endif
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!done()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  pclose(pipe);
  return text;
}

/// A child process, ended with the object.
class Process {
 public:
  Process(const std::vector<std::string>& command, const fs::path& folder) {
    pid_ = fork();
    if (pid_ != 0) return;
    fs::current_path(folder);
    std::vector<char*> arguments;
    for (const std::string& argument : command) {
      arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Process() {
    if (!exit_code()) {
      kill(pid_, SIGTERM);
      waitpid(pid_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Null while it runs; -1 if a signal ended it.
  std::optional<int> exit_code() {
    int status = 0;
    if (!code_ && waitpid(pid_, &status, WNOHANG) == pid_) {
      code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    return code_;
  }
  /// Of all its threads so far.
  [[nodiscard]] double cpu_seconds() const {
    std::ifstream stream("/proc/" + std::to_string(pid_) + "/stat");
    std::string word;
    // The fields after the name in parentheses, which may hold spaces: the 12th and 13th.
    std::getline(stream, word, ')');
    double user = 0;
    double system = 0;
    for (int i = 0; i < 11; ++i) stream >> word;
    stream >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

 private:
  pid_t pid_ = -1;
  std::optional<int> code_;
};

class Window : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* tool : {"Xvfb", "xdotool"}) {
      ASSERT_FALSE(output_of(std::string("command -v ") + tool).empty())
          << tool << " is missing: apt-get install xvfb xdotool";
    }
    folder_ = fs::temp_directory_path() / ("lightbench-window-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    setenv("XDG_STATE_HOME", folder_.c_str(), 1);
    unsetenv("WAYLAND_DISPLAY");
    Scene scene =
        load_scene(std::string(LIGHTBENCH_SOURCE_DIR) + "/scenes/cornell-three-lights.json");
    scene.render.width = scene.render.height = 100;
    scene.render.spp = 0;
    scene.render.snapshots.clear();
    file_ = folder_ / "box.json";
    save_scene(scene, file_);
  }
  void TearDown() override {
    viewer_.reset();
    server_.reset();
    fs::remove_all(folder_);
  }

  /// Positions of the widgets with `panel` in front, in a window of the same size.
  nlohmann::json widgets_with(const std::string& panel) {
    const fs::path script = folder_ / "script.json";
    const fs::path list = folder_ / "widgets.json";
    std::ofstream(script) << nlohmann::json{{{"show", panel}}, {{"widgets", list.string()}}};
    const std::string command = std::string(LIGHTBENCH_EXE) + " screenshot " + file_.string() +
                                " -q --spp 1 --size 1280x720 --script " + script.string() + " -o " +
                                (folder_ / "screenshot.png").string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream stream(list);
    return nlohmann::json::parse(stream);
  }

  void xdotool(const std::string& what) {
    EXPECT_EQ(std::system(("xdotool " + what).c_str()), 0) << what;
    // As fast as a person could be; ImGui needs to see each event.
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  void point_at(const nlohmann::json& widgets, const std::string& name) {
    const auto place = widgets.at(name).get<std::array<double, 4>>();
    xdotool("mousemove " + std::to_string(std::lround(0.5 * (place[0] + place[2]))) + " " +
            std::to_string(std::lround(0.5 * (place[1] + place[3]))));
  }
  Scene saved() {
    xdotool("key ctrl+s");
    return load_scene(file_);
  }

  /// The viewer on the scene at the top left of a screen of its own, with the keyboard.
  void open_viewer() {
    const std::string display = ":" + std::to_string(200 + getpid() % 5000);
    // -noreset: or it would start over when the first xdotool leaves, and drop a viewer that comes
    // at that moment.
    server_.emplace(std::vector<std::string>{"Xvfb", display, "-screen", "0", "1280x720x24",
                                             "-nolisten", "tcp", "-noreset"},
                    folder_);
    setenv("DISPLAY", display.c_str(), 1);
    ASSERT_TRUE(wait_until(20, [] {
      return std::system("xdotool getdisplaygeometry > /dev/null 2>&1") == 0;
    })) << "Xvfb did not start";
#ifdef __SANITIZE_ADDRESS__
    // A window's driver leaves memory behind and is unloaded: no suppression can name it then.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
#endif
    viewer_.emplace(
        std::vector<std::string>{LIGHTBENCH_EXE, "view", file_.string(), "--ui-scale", "1"},
        folder_);
    ASSERT_TRUE(wait_until(60, [&] {
      window_ = output_of("xdotool search --onlyvisible --name 'box.* - Lightbench' 2> /dev/null");
      return !window_.empty() || viewer_->exit_code();
    }));
    ASSERT_FALSE(viewer_->exit_code()) << "the viewer stopped";
    window_.erase(window_.find_first_of('\n'));
    xdotool("windowmove " + window_ + " 0 0 windowfocus " + window_);
  }
  /// Drags across the picture until the camera that is saved has moved.
  bool orbit(const nlohmann::json& widgets) {
    const Camera start = load_scene(file_).camera;
    return wait_until(60, [&] {
      point_at(widgets, "Picture/View");
      xdotool("mousedown 1");
      xdotool("mousemove_relative 60 20");
      xdotool("mousemove_relative 60 20");
      xdotool("mouseup 1");
      return saved().camera.look_from != start.look_from;
    });
  }
  std::size_t snapshots() {
    std::error_code error;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out", error)) {
      count += entry.path().extension() == ".png" ? 1U : 0U;
    }
    return count;
  }

  fs::path folder_;
  fs::path file_;
  std::optional<Process> server_;
  std::optional<Process> viewer_;  ///< ends before its screen
  std::string window_;
};

TEST_F(Window, OrbitApertureLightSnapshotSaveQuit) {
  const nlohmann::json camera = widgets_with("Camera");
  const nlohmann::json lights = widgets_with("Lights");
  ASSERT_NO_FATAL_FAILURE(open_viewer());
  Process& viewer = *viewer_;

  ASSERT_TRUE(orbit(camera));

  // Type an aperture.
  ASSERT_TRUE(wait_until(60, [&] {
    point_at(camera, "Tab/Camera");
    xdotool("click 1");
    point_at(camera, "Camera/Aperture");
    xdotool("keydown ctrl click 1 keyup ctrl");
    xdotool("type 25");
    xdotool("key Return");
    return saved().camera.lens_radius == 25;
  }));

  // Add a light.
  const std::size_t objects = load_scene(file_).objects.size();
  ASSERT_TRUE(wait_until(60, [&] {
    point_at(lights, "Tab/Lights");
    xdotool("click 1");
    point_at(lights, "Lights/Add light");
    xdotool("click 1");
    return saved().objects.size() > objects;
  }));
  const Scene lit = load_scene(file_);
  EXPECT_TRUE(emits(lit.materials[static_cast<std::size_t>(lit.objects.back().material)]));

  // A snapshot, while the render goes on.
  EXPECT_TRUE(wait_until(60, [&] {
    xdotool("key Escape");
    xdotool("key F12");
    return wait_until(5, [&] { return snapshots() > 0; });
  }));

  // A repeated step may have left an edit unsaved, which the viewer would ask about.
  ASSERT_TRUE(wait_until(60, [&] {
    xdotool("key Escape");
    xdotool("key ctrl+s");
    xdotool("key ctrl+q");
    return wait_until(1, [&] { return viewer.exit_code().has_value(); });
  }));
  EXPECT_EQ(viewer.exit_code(), 0);
}

/// Without a window manager, so that nothing corrects a size or keeps the window in sight.
TEST_F(Window, AnySizeAndOutOfSight) {
  const nlohmann::json camera = widgets_with("Camera");
  ASSERT_NO_FATAL_FAILURE(open_viewer());
  const auto resize = [&](const std::string& size) {
    xdotool("windowsize " + window_ + " " + size);
  };
  const auto size_is = [&](const std::string& size) {
    return wait_until(20, [&] {
      return output_of("xdotool getwindowgeometry " + window_).find(size) != std::string::npos;
    });
  };
  // A loop that spins takes its share in every interval.
  const auto rests = [&] {
    return wait_until(60, [&] {
      const double before = viewer_->cpu_seconds();
      std::this_thread::sleep_for(std::chrono::seconds(1));
      return viewer_->cpu_seconds() - before < 0.05;
    });
  };
  for (const char* size : {"3x600", "700x2", "40x30", "1x1"}) {
    std::string numbers = size;
    std::replace(numbers.begin(), numbers.end(), 'x', ' ');
    resize(numbers);
    EXPECT_TRUE(size_is(size)) << size;
    ASSERT_FALSE(viewer_->exit_code()) << "stopped at " << size;
  }
  // The render goes on meanwhile, and with it the snapshots; before its first pass there is none.
  xdotool("windowfocus " + window_);
  EXPECT_TRUE(wait_until(60, [&] {
    xdotool("key F12");
    return wait_until(10, [&] { return snapshots() == 1; });
  }));
  xdotool("windowunmap " + window_);
  EXPECT_TRUE(wait_until(60, [&] {
    return output_of("xdotool search --onlyvisible --name Lightbench 2> /dev/null").empty();
  }));
  ASSERT_FALSE(viewer_->exit_code()) << "stopped out of sight";
  xdotool("windowmap " + window_);
  resize("1280 720");
  EXPECT_TRUE(size_is("1280x720"));
  xdotool("windowmove " + window_ + " 0 0 windowfocus " + window_);
  EXPECT_TRUE(orbit(camera));  // where it was: the layout is back
  xdotool("key space");
  EXPECT_TRUE(rests());
  xdotool("windowunmap " + window_);
  EXPECT_TRUE(rests());
  xdotool("windowmap " + window_);
  resize("1 1");
  EXPECT_TRUE(size_is("1x1"));
  EXPECT_TRUE(rests());
  EXPECT_FALSE(viewer_->exit_code());
}

TEST_F(Window, WithoutADisplayOneLineAndExitCode2) {
  const std::string command = "env -u DISPLAY -u WAYLAND_DISPLAY " + std::string(LIGHTBENCH_EXE) +
                              " view " + file_.string() + " 2>&1; echo code $?";
  const std::string text = output_of(command);
  EXPECT_NE(text.find("code 2"), std::string::npos) << text;
  EXPECT_NE(text.find("lightbench render"), std::string::npos) << text;
  EXPECT_NE(text.find("lightbench screenshot"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
}

}  // namespace
}  // namespace lightbench
