// The reference of all figures in seconds of a compiler: one fixed source, compiled without a
// cache. The reference of a simulation's seconds is the bare engine's step (bench_simulators).

#include <cstdlib>
#include <stdexcept>
#include <string>

#include <benchmark/benchmark.h>

namespace {

void compile_reference(benchmark::State& state) {
  const std::string command =
      TOUCHDOWN_COMPILER " -std=c++20 -O2 -c " TOUCHDOWN_SOURCE_DIR
                         "/tests/benchmarks/reference/compiled_source.cpp -o /dev/null";
  for (auto _ : state) {
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  }
}
BENCHMARK(compile_reference)->Unit(benchmark::kSecond)->Iterations(3)->UseRealTime();

}  // namespace
