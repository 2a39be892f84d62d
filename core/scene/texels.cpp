#include "core/scene/texels.h"

#include <bit>
#include <utility>

namespace lightbench {
namespace {

/// Numbers up to 256 different values in the order in which they come.
class Palette {
 public:
  static constexpr std::uint32_t kFull = 256;

  /// The number of `value`, or kFull if it is the 257th.
  std::uint32_t number(float value) {
    const auto key = std::bit_cast<std::uint32_t>(value);
    // Open addressing: at most half of the slots are taken.
    for (std::uint32_t slot = key * 0x9e3779b1U >> 23;; slot = (slot + 1) % kSlots) {
      if (taken_[slot] == 0) {
        if (values_.size() == kFull) return kFull;
        values_.push_back(value);
        keys_[slot] = key;
        taken_[slot] = static_cast<std::uint16_t>(values_.size());
      }
      if (keys_[slot] == key) return taken_[slot] - 1U;
    }
  }
  /// All 256; those beyond the last are 0.
  [[nodiscard]] std::vector<float> values() const {
    std::vector<float> all = values_;
    all.resize(kFull);
    return all;
  }

 private:
  static constexpr std::uint32_t kSlots = 512;
  std::uint32_t keys_[kSlots] = {};
  std::uint16_t taken_[kSlots] = {};  // number + 1
  std::vector<float> values_;
};

}  // namespace

Texels make_texels(Image image) {
  Texels texels{image.width, image.height, {}, {}, {}};
  Palette palette;
  // Reserved, not filled: an image of more values is found out after the first few.
  texels.packed.reserve(texels.count());
  for (std::size_t i = 0; i < texels.count(); ++i) {
    std::uint32_t numbers = 0;
    for (unsigned k = 0; k < 3; ++k) {
      const std::uint32_t number = palette.number(image.rgb[3 * i + k]);
      if (number == Palette::kFull) {
        texels.packed = {};
        texels.rgb = std::move(image.rgb);
        return texels;
      }
      numbers |= number << (8 * k);
    }
    texels.packed.push_back(numbers);
  }
  texels.values = palette.values();
  return texels;
}

}  // namespace lightbench
