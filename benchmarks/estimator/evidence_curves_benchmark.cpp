#include <cmath>
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/evidence/filter.hpp"
#include "estimator/evidence/pairs.hpp"
#include "signals_for_benchmarks.hpp"

namespace touchdown {
namespace {

EvidenceModel wavy_model(bool with_pairs) {
  EvidenceModel model;
  const auto fill = [](auto& numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = 0.1F * std::sin(static_cast<float>(i));
    }
  };
  for (EvidenceCurve& curve : model.curve) fill(curve);
  if (with_pairs) model.table.resize(evidence_pairs.size());
  for (EvidenceTable& table : model.table) fill(table);
  return model;
}

/// One `update` for both wheels: channels, time scales, noise levels, curves, tables. Compare with
/// `yardstick_fft_128` of the same run.
void update_evidence(benchmark::State& state, bool with_pairs) {
  EvidenceCurves estimator(wavy_model(with_pairs));
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
BENCHMARK_CAPTURE(update_evidence, curves, false)->Name("update/evidence_curves");
BENCHMARK_CAPTURE(update_evidence, pairs, true)->Name("update/evidence_pairs");

}  // namespace
}  // namespace touchdown
