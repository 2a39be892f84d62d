#include "core/scene/picture_hash.h"

#include <string_view>
#include <vector>

#include "core/scene/json_write.h"

namespace lightbench {
namespace {

class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
  }
  /// Of numbers, or of vectors and arrays of them: what has no padding.
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  }
  void add(const Texels& image) {
    add(std::vector<int>{image.width, image.height});
    for (std::size_t i = 0; i < image.count(); ++i) {
      const std::array<float, 3> color = image.color(i);
      add(std::string_view(reinterpret_cast<const char*>(color.data()), sizeof color));
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace

std::uint64_t picture_hash(const Scene& scene) {
  Scene s = scene;
  const RenderSettings settings = s.render;
  s.display = {};
  s.render = {};
  s.render.width = settings.width;
  s.render.height = settings.height;
  s.render.crop = settings.crop;
  s.render.max_depth = settings.max_depth;
  s.render.filter = settings.filter;
  s.render.filter_radius = settings.filter_radius;
  // Files count by what is in them, wherever they lie.
  Fnv1a hash;
  for (Texture& texture : s.textures) {
    if (texture.image) hash.add(*texture.image);
    if (!texture.file.empty()) texture.file = "image";
  }
  for (MeshAsset& mesh : s.meshes) {
    if (mesh.file.empty() || !mesh.data) continue;  // inline data is in the document
    hash.add(mesh.data->positions);
    hash.add(mesh.data->normals);
    hash.add(mesh.data->uvs);
    hash.add(mesh.data->triangles);
    mesh.file = "mesh";
  }
  if (s.environment.image) hash.add(*s.environment.image);
  if (!s.environment.file.empty()) s.environment.file = "image";
  hash.add(write_scene(s, {}).dump());
  return hash.value();
}

}  // namespace lightbench
