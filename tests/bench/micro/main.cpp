// Micro-benchmarks (Google Benchmark): bin/bench_micro --benchmark_filter=REGEX. For ratios between
// lines: --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true.

#include <benchmark/benchmark.h>

namespace lightbench::micro {
void add_building();
void add_functions();
void add_spheres();
void add_traversal();
}  // namespace lightbench::micro

int main(int argc, char** argv) {
  lightbench::micro::add_functions();
  lightbench::micro::add_building();
  lightbench::micro::add_traversal();
  lightbench::micro::add_spheres();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
