// OpenEXR from and to memory.

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "core/film/image_formats.h"

namespace lightbench {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : Imf::IStream("image"), bytes_(bytes) {}
  bool read(char* target, int count) override {
    const auto size = static_cast<std::uint64_t>(count);
    if (count < 0 || position_ > bytes_.size() || size > bytes_.size() - position_)
      throw std::runtime_error("the file ends too early");
    std::memcpy(target, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t position_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("image") {}
  void write(const char* source, int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ + size > bytes.size()) bytes.resize(position_ + size);
    std::memcpy(bytes.data() + position_, source, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  std::uint64_t position_ = 0;
};

constexpr float kLargestHalf = 65504;

half to_half(float value) { return half(std::clamp(value, -kLargestHalf, kLargestHalf)); }

}  // namespace

std::string encode_exr(const Image& image, const ImageMetadata& metadata,
                       const std::vector<float>& variance, ExrNumbers numbers) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709, D65
  for (const auto& [key, value] : metadata)
    if (!key.empty()) header.insert(key, Imf::StringAttribute(value));

  const auto width = static_cast<std::size_t>(image.width);
  std::vector<half> halves;
  if (numbers == ExrNumbers::Half) {
    halves.resize(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), halves.begin(), to_half);
  }
  std::vector<float> floats(numbers == ExrNumbers::Float ? image.rgb : std::vector<float>());
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto add = [&](auto& values, Imf::PixelType type) {
      const std::size_t step = 3 * sizeof values[0];
      header.channels().insert(names[c], Imf::Channel(type));
      frame.insert(names[c], Imf::Slice(type, reinterpret_cast<char*>(values.data() + c), step,
                                        step * width));
    };
    if (numbers == ExrNumbers::Half) {
      add(halves, Imf::HALF);
    } else {
      add(floats, Imf::FLOAT);
    }
  }
  std::vector<float> variances(variance);
  if (!variances.empty()) {
    header.channels().insert("variance.Y", Imf::Channel(Imf::FLOAT));
    frame.insert("variance.Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(variances.data()),
                                          sizeof(float), sizeof(float) * width));
  }
  MemoryOutput stream;
  {
    Imf::OutputFile file(stream, header);  // its destructor completes the line table
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  }
  return std::move(stream.bytes);
}

ImageMetadata decode_exr_metadata(std::string_view bytes) {
  MemoryInput stream(bytes);
  const Imf::InputFile file(stream);
  ImageMetadata metadata;
  for (auto a = file.header().begin(); a != file.header().end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text != nullptr) metadata[a.name()] = text->value();
  }
  return metadata;
}

Image decode_exr(std::string_view bytes) {
  MemoryInput stream(bytes);
  Imf::InputFile file(stream);
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = std::int64_t{window.max.x} - window.min.x + 1;
  const auto height = std::int64_t{window.max.y} - window.min.y + 1;
  check_image_size(width, height, bytes.size());

  const Imf::ChannelList& channels = file.header().channels();
  const bool grey = channels.findChannel("R") == nullptr && channels.findChannel("Y") != nullptr;
  Image image{static_cast<int>(width), static_cast<int>(height), {}};
  image.rgb.resize(3 * image.pixel_count());
  const auto pixel_bytes = static_cast<std::int64_t>(3 * sizeof(float));
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < (grey ? 1 : 3); ++c) {
    const char* name = grey ? "Y" : names[c];
    const Imf::Channel* channel = channels.findChannel(name);
    if (channel == nullptr) throw std::runtime_error("expected channels R, G and B, or Y");
    if (channel->xSampling != 1 || channel->ySampling != 1)
      throw std::runtime_error("expected channels at full resolution");
    frame.insert(name, Imf::Slice::Make(Imf::FLOAT, image.rgb.data() + c, window,
                                        static_cast<std::size_t>(pixel_bytes),
                                        static_cast<std::size_t>(pixel_bytes * width)));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  if (grey) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
      image.rgb[i + 1] = image.rgb[i + 2] = image.rgb[i];
  }
  return image;
}

}  // namespace lightbench
