#pragma once
// Small pictures with a bit of everything, for comparing ways of rendering with each other.

#include <string>

#include "app/stress/random.h"
#include "core/scene/scene.h"

namespace lightbench::stress {

/// A closed room seen from within, four objects of any shape and material, two lights that emit
/// from both sides; some rooms also have fog, a lens, or something that moves.
Scene random_room(Random& random, int size);

/// What is in it, in one line.
std::string describe_room(const Scene& scene);

}  // namespace lightbench::stress
