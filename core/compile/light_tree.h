#pragma once
// The tree by which points choose among many lights (core/lights/light_tree.h).

#include <vector>

#include "core/compile/light_place.h"
#include "core/compile/parts.h"

namespace lightbench {

/// Builds the tree of the lamps that weigh something: halves by count along the longest side of
/// their centres, so that its depth is the logarithm of their number.
template <class T>
void add_light_tree(const std::vector<Lamp>& lamps, LightPart<T>& lights);

}  // namespace lightbench
