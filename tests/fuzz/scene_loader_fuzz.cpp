// libFuzzer target for the scene loader, built by clang with -DLIGHTBENCH_FUZZ=ON:
//   fuzz_scene_loader -max_len=8192 CORPUS_FOLDER scenes/features
// Any exception but Error, any sanitizer report and any scene that is accepted but cannot be saved
// and read back is a crash.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "core/scene/scene_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  lightbench::Scene scene;
  try {
    scene = lightbench::parse_scene(text, "/nowhere", "fuzz");
  } catch (const lightbench::Error& error) {
    if (std::string(error.what()).find('\n') != std::string::npos)
      throw std::logic_error("a message of two lines");
    return 0;
  }
  const std::string saved = lightbench::scene_to_json(scene, "/nowhere");
  const lightbench::Scene again = lightbench::parse_scene(saved, "/nowhere", "saved");
  if (lightbench::scene_to_json(again, "/nowhere") != saved)
    throw std::logic_error("a scene that changes when saved");
  return 0;
}
