#include <cmath>
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/decision/filter.hpp"
#include "signals_for_benchmarks.hpp"

namespace touchdown {
namespace {

/// Weights that keep every layer busy.
DecisionModel busy_model() {
  DecisionModel model;
  const auto fill = [](auto& numbers, float size) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = size * std::sin(static_cast<float>(i));
    }
  };
  fill(model.first_weight, 0.2F);
  fill(model.second_weight, 0.3F);
  fill(model.last_weight, 0.5F);
  return model;
}

/// One `update` for both wheels: channels, time scales, noise levels, network. Compare with
/// `yardstick_fft_128` of the same run.
void update_decision_network(benchmark::State& state) {
  DecisionNetwork estimator(busy_model());
  std::vector<Signals> stream = bench::signals(4096);
  std::size_t i = 0;
  double time = 0.0;
  for (auto _ : state) {
    Signals& s = stream[i];
    s.time = time += 0.001;
    benchmark::DoNotOptimize(double{estimator.update(s).p_any_wheel});
    i = (i + 1) % stream.size();
  }
}
BENCHMARK(update_decision_network)->Name("update/decision_network");

}  // namespace
}  // namespace touchdown
