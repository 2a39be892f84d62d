#pragma once
// From a Scene to a JSON document, and the document to text that people can edit.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/scene/scene.h"

namespace lightbench {

using OrderedJson = nlohmann::ordered_json;

/// Members in the order of docs/scene-format.md, those at their default left out. Assets are named
/// relative to `directory`.
OrderedJson write_scene(const Scene& scene, const std::filesystem::path& directory);

/// Indented by two; arrays and objects that fit stay on one line. Ends with a newline. Throws
/// Json::exception if a string is not UTF-8.
std::string format_json(const OrderedJson& document);

}  // namespace lightbench
