#pragma once
// From a JSON document to a Scene whose files are named but not yet loaded.

#include "core/scene/json_cursor.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Types, keys and references are checked; ranges are validate()'s business. File names are taken
/// as written. Throws Error{Scene} that starts with the JSON pointer.
Scene read_scene(const Json& document);

}  // namespace lightbench
