#pragma once
// What the properties panel shows.

#include "core/scene/scene.h"

namespace lightbench::ui {

enum class ItemKind { None, Object, Material, Texture, Medium };

/// `index` is into the scene's list of that kind.
struct Selection {
  ItemKind kind = ItemKind::None;
  int index = kNone;
  bool operator==(const Selection&) const = default;
};

}  // namespace lightbench::ui
