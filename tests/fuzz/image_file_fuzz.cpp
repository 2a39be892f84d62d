// libFuzzer target for the image decoders, built by clang with -DLIGHTBENCH_FUZZ=ON:
//   fuzz_image_file -max_len=4096 CORPUS_FOLDER
// Reads through a file, as the loader does.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "core/film/image_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file =
      std::filesystem::temp_directory_path() / ("lightbench-fuzz-" + std::to_string(::getpid()));
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const lightbench::Image image = lightbench::read_image(file);
    if (image.rgb.size() != 3 * image.pixel_count()) throw std::logic_error("a half-read image");
  } catch (const lightbench::Error&) {
    return 0;  // refused in words
  }
  return 0;
}
