#pragma once
// `-D /json/pointer=value`: edits of the document before it is read.

#include "core/scene/json_cursor.h"
#include "core/scene/scene_io.h"

namespace lightbench {

/// Places the value at the pointer (RFC 6901). Missing members are created; an array element must
/// exist, and may be given by the "name" it has instead of its number (/materials/glass/ior).
/// Throws Error{Scene} that starts with the pointer.
void apply_override(Json& document, const Override& change);

}  // namespace lightbench
