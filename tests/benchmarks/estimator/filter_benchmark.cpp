#include <complex>
#include <memory>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/bayes/filter.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "experiments/batch/bayes.hpp"
#include "tests/estimator/named_config.hpp"
#include "time_updates.hpp"

namespace touchdown {
namespace {

/// The reference FFT: one real transform of 128 samples.
void reference_fft_128(benchmark::State& state) {
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> window(128);
  std::vector<std::complex<double>> spectrum(65);
  for (std::size_t i = 0; i < window.size(); ++i) {
    window[i] = std::sin(0.3 * static_cast<double>(i));
  }
  fft.fwd(spectrum, window);
  for (auto _ : state) {
    fft.fwd(spectrum.data(), window.data(), 128);
    benchmark::DoNotOptimize(spectrum.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(reference_fft_128);

std::unique_ptr<ContactEstimator> estimator(const char* name) {
  if (std::string(name) == "measurement_only") {
    return std::make_unique<MeasurementOnly>(bench::model(BayesFilterConfig::robust()));
  }
  const BayesFilterConfig config = test::named(name);
  return std::make_unique<BayesFilter>(bench::model(config), config);
}

/// One transition, and for both wheels lookup and recursion.
void update(benchmark::State& state, const char* name) {
  bench::time_updates(state, *estimator(name));
}
BENCHMARK_CAPTURE(update, paper, "paper");
BENCHMARK_CAPTURE(update, reference, "reference");
BENCHMARK_CAPTURE(update, robust, "robust");
BENCHMARK_CAPTURE(update, measurement_only, "measurement_only");

void latency(benchmark::State& state, const char* name) {
  bench::time_every_update(state, *estimator(name));
}
BENCHMARK_CAPTURE(latency, robust, "robust")->Iterations(250);
BENCHMARK_CAPTURE(latency, reference, "reference")->Iterations(250);

/// A sweep over a batch of `torques` × `accelerations` noise levels. The time per item is that of
/// one level's update, which covers both wheels.
void batch_update(benchmark::State& state, const char* name, int torques, int accelerations) {
  const BayesFilterConfig config = test::named(name);
  std::vector<experiments::BatchNoise> levels;
  for (int i = 0; i < torques; ++i) {
    for (int j = 0; j < accelerations; ++j) {
      levels.push_back({0.5 * i, 0.5 * i, 2.0 * j});
    }
  }
  if (accelerations == 0) {  // no two levels have anything in common
    for (int i = 0; i < torques; ++i) {
      levels.push_back({0.1 * i, 0.1 * i, 0.3 * i});
    }
  }
  experiments::BatchedBayesFilter batch(bench::model(config), config, levels);
  const std::vector<Signals> stream = bench::signals(bench::stream_length);
  const std::vector<Signals> noise = bench::signals(bench::stream_length + 7);
  std::size_t i = 0;
  for (auto _ : state) {
    experiments::NoiseStep draws;
    draws.acceleration = noise[i + 7].leg[0].knee.torque;
    for (std::size_t side = 0; side < 2; ++side) {
      draws.torque[side] = {noise[i].leg[side].knee.torque, noise[i].leg[side].wheel.torque};
    }
    batch.update(stream[i], draws);
    benchmark::DoNotOptimize(batch.p_contact(Side::left).data());
    benchmark::ClobberMemory();
    i = (i + 1) % bench::stream_length;
  }
  state.counters["per_level_update"] = benchmark::Counter(
      static_cast<double>(levels.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(batch_update, robust_grid_6x6, "robust", 6, 6);
BENCHMARK_CAPTURE(batch_update, robust_36_distinct, "robust", 36, 0);
BENCHMARK_CAPTURE(batch_update, paper_grid_6x6, "paper", 6, 6);
BENCHMARK_CAPTURE(batch_update, reference_grid_6x6, "reference", 6, 6);
BENCHMARK_CAPTURE(batch_update, reference_36_distinct, "reference", 36, 0);

}  // namespace
}  // namespace touchdown
