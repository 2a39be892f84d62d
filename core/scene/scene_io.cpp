#include "core/scene/scene_io.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/film/image_file.h"
#include "core/scene/file.h"
#include "core/scene/json_read.h"
#include "core/scene/json_write.h"
#include "core/scene/override.h"

namespace lightbench {
namespace {

constexpr int kDeepestNesting = 32;

/// Names that people choose may hold line breaks; messages may not.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

/// "[json.exception.parse_error.101] parse error at line 3, column 5: ..." without its first word.
std::string plain_message(const Json::exception& error) {
  std::string message = error.what();
  if (const auto end = message.find("] "); message.starts_with('[') && end != std::string::npos)
    message.erase(0, end + 2);
  return message;
}

/// Parses, refusing what nlohmann-json alone would accept in silence: the same key twice.
Json parse_document(const std::string& text) {
  std::vector<std::set<std::string>> keys;
  const auto watch = [&keys](int depth, Json::parse_event_t event, const Json& value) {
    switch (event) {
      case Json::parse_event_t::object_start:
      case Json::parse_event_t::array_start:
        if (depth >= kDeepestNesting)
          throw Error(ErrorKind::Scene, "expected at most 32 levels of nesting");
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        break;
      case Json::parse_event_t::object_end:
        keys.pop_back();
        break;
      case Json::parse_event_t::key:
        if (!keys.back().insert(value.get_ref<const std::string&>()).second)
          throw Error(ErrorKind::Scene, "the key " + describe(value) + " appears twice");
        break;
      default:
        break;
    }
    return true;
  };
  return Json::parse(text, watch);
}

std::string absolute_name(const std::string& name, const std::filesystem::path& directory) {
  // "." for a bare scene name: its folder is the empty path, which absolute() refuses.
  return (std::filesystem::absolute("." / directory) / name).lexically_normal().string();
}

/// Files that several assets name are loaded once, and their payload is shared.
class AssetLoader {
 public:
  explicit AssetLoader(const std::filesystem::path& directory) : directory_(directory) {}

  void load(Scene& scene) {
    Environment& environment = scene.environment;
    if (!environment.file.empty())
      environment.image = image("/environment/file", environment.file, true);
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
      Texture& texture = scene.textures[i];
      if (!texture.file.empty())
        texture.image = image(at("/textures/", i), texture.file, texture.srgb);
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
      MeshAsset& mesh = scene.meshes[i];
      if (!mesh.file.empty()) {
        mesh.data =
            once(meshes_, mesh.file, at("/meshes/", i), [&] { return load_mesh(mesh.file); });
      }
    }
  }

 private:
  static std::string at(const char* list, std::size_t index) {
    return list + std::to_string(index) + "/file";
  }

  std::shared_ptr<const Texels> image(const std::string& pointer, std::string& file, bool srgb) {
    return once(images_[srgb ? 1 : 0], file, pointer, [&] { return load_image(file, srgb); });
  }

  /// Makes `file` absolute, and returns what `read` gives for it or gave before.
  template <class T, class Read>
  std::shared_ptr<const T> once(std::map<std::string, std::shared_ptr<const T>>& loaded,
                                std::string& file, const std::string& pointer, Read read) {
    file = absolute_name(file, directory_);
    std::shared_ptr<const T>& slot = loaded[file];
    if (slot) return slot;
    try {
      return slot = read();
    } catch (const Error& error) {
      throw Error(ErrorKind::Scene, pointer + ": " + error.what());
    }
  }

  std::filesystem::path directory_;
  std::map<std::string, std::shared_ptr<const Texels>> images_[2];
  std::map<std::string, std::shared_ptr<const Mesh>> meshes_;
};

}  // namespace

Scene parse_scene(const std::string& text, const std::filesystem::path& directory,
                  const std::string& label, const std::vector<Override>& overrides) {
  try {
    Json document = parse_document(text);
    for (const Override& change : overrides) apply_override(document, change);
    Scene scene = read_scene(document);
    AssetLoader(directory).load(scene);
    validate(scene);
    return scene;
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::Scene, one_line(label + ": " + plain_message(error)));
  } catch (const Error& error) {
    throw Error(ErrorKind::Scene, one_line(label + ": " + error.what()));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::Scene, label + ": does not fit in memory");
  } catch (const std::filesystem::filesystem_error& error) {
    throw Error(ErrorKind::Scene, one_line(label + ": " + error.what()));
  }
}

Scene load_scene(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_scene(read_file(file), file.parent_path(), file.string(), overrides);
}

std::string scene_to_json(const Scene& scene, const std::filesystem::path& directory) {
  validate(scene);
  try {
    return format_json(write_scene(scene, directory));
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::Output, "expected names in UTF-8: " + plain_message(error));
  }
}

void save_scene(const Scene& scene, const std::filesystem::path& file) {
  replace_file(file, scene_to_json(scene, file.parent_path()));
}

// High-dynamic-range files in the wild hold infinities (a sun too bright for half floats), NaN and
// the negative lobes of resampling filters; one such texel would poison every path that sees it.
std::shared_ptr<const Texels> load_image(const std::filesystem::path& file, bool srgb) {
  constexpr float kBrightest = 1e12F;
  Image image = read_image(file, srgb);
  for (float& value : image.rgb) value = value > 0 ? std::min(value, kBrightest) : 0.0F;
  return std::make_shared<const Texels>(make_texels(std::move(image)));
}

}  // namespace lightbench
