#pragma once
// What this program is and what it can run on.

#include <string>

namespace lightbench {

/// Such as `0.1.0`.
std::string version_number();

/// Version, commit if it was built from one, compiler, and kernels that this processor runs.
std::string version_text();

}  // namespace lightbench
