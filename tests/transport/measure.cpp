#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;

std::ostream& operator<<(std::ostream& out, const KernelUnderTest& kernel) {
  return out << kernel_name(kernel.kind);
}

}  // namespace lightbench
