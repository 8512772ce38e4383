#include <cmath>
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/evidence/filter.hpp"
#include "estimator/evidence/pairs.hpp"
#include "estimator/evidence/touchdown.hpp"
#include "signals_for_benchmarks.hpp"

namespace touchdown {
namespace {

void fill(auto& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = 0.1F * std::sin(static_cast<float>(i));
  }
}

EvidenceModel wavy_model(bool with_pairs) {
  EvidenceModel model;
  for (EvidenceCurve& curve : model.curve) fill(curve);
  if (with_pairs) model.table.resize(evidence_pairs.size());
  for (EvidenceTable& table : model.table) fill(table);
  return model;
}

/// One `update` for both wheels: channels, time scales, noise levels, curves, tables, network.
/// Compare with `yardstick_fft_128` of the same run.
void update(benchmark::State& state, ContactEstimator&& estimator) {
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

void update_curves(benchmark::State& state) { update(state, EvidenceCurves(wavy_model(false))); }
BENCHMARK(update_curves)->Name("update/evidence_curves");

void update_pairs(benchmark::State& state) { update(state, EvidenceCurves(wavy_model(true))); }
BENCHMARK(update_pairs)->Name("update/evidence_pairs");

void update_touchdown(benchmark::State& state) {
  DecisionModel network;
  fill(network.first_weight);
  fill(network.second_weight);
  fill(network.last_weight);
  update(state, TouchdownEstimator({wavy_model(false), network}));
}
BENCHMARK(update_touchdown)->Name("update/touchdown");

}  // namespace
}  // namespace touchdown
