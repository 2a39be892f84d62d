// The compiler's part: floating point as written, with the flags of every kernel.

#include "app/proof/arithmetic.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
using namespace proof;

void add_arithmetic_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"arithmetic",
       "with the flags of every kernel that this processor runs, in float and double: rounding to "
       "float, a*b-c*d not fused, a+b+c not reassociated, exact division, 1/0, NaN, denormals",
       {{"the compiler keeps arithmetic as written", "", kNoLimit, kNoLimit, 0}},
       1,
       1,
       1,
       [](KernelKind) -> Chunk {
         return [](Random&, std::uint64_t, std::span<Tally> tallies) {
           for (const proof::arithmetic::Check& check : proof::arithmetic::all_supported()) {
             tallies[0].trial();
             if (!check.kept) tallies[0].fail([&] { return "not so: " + check.what; });
           }
         };
       }});
}

}  // namespace lightbench::stress
