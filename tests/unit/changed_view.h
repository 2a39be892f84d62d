#pragma once
// A compiled scene of which the kernel is told something else.

#include <memory>
#include <utility>
#include <variant>

#include "core/compile/parts.h"
#include "core/compile/render_scene.h"

namespace lightbench {

/// The same scene after f(view) of its kernel's view.
template <class F>
RenderScene with_changed_view(const RenderScene& scene, F f) {
  RenderScene copy = scene;
  auto parts = std::make_shared<RenderScene::Parts>(*scene.parts);
  std::visit([&f](auto& kernel) { f(kernel.view); }, parts->kernel);
  copy.parts = std::move(parts);
  return copy;
}

}  // namespace lightbench
