#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/numerics/kernel_density.hpp"

namespace touchdown {
namespace {

/// 84,000 samples on 200 × 200 points: seven minutes of two legs at 100 Hz.
void kernel_density_84k(benchmark::State& state) {
  std::mt19937 engine(1);
  const auto uniform = [&engine] { return static_cast<double>(engine()) / 4294967296.0; };
  std::vector<double> knee(84'000);
  std::vector<double> wheel(84'000);
  for (std::size_t i = 0; i < knee.size(); ++i) {
    knee[i] = 1.3 + uniform() + uniform() - 1.0;
    wheel[i] = 0.4 * uniform();
  }
  const double knee_bandwidth = scott_bandwidth(knee, 2);
  const double wheel_bandwidth = scott_bandwidth(wheel, 2);
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernel_density(wheel, knee, wheel_bandwidth, knee_bandwidth,
                                            Axis{0.0, 0.75, 200}, Axis{0.0, 3.0, 200}));
  }
}
BENCHMARK(kernel_density_84k)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace touchdown
