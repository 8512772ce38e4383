#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/contact_estimator.hpp"
#include "signals_for_benchmarks.hpp"

namespace touchdown::bench {

inline constexpr std::size_t stream_length = 4096;

/// One `update` for both wheels. Compare with `reference_fft_128` of the same run.
inline void time_updates(benchmark::State& state, ContactEstimator& estimator) {
  std::vector<Signals> stream = signals(stream_length);
  std::size_t i = 0;
  double time = 0.0;
  for (auto _ : state) {
    Signals& s = stream[i];
    s.time = time += 0.001;
    benchmark::DoNotOptimize(double{estimator.update(s).p_any_wheel});
    i = (i + 1) % stream_length;
  }
}

/// The time of every single update, clock included, as percentiles (ns).
inline void time_every_update(benchmark::State& state, ContactEstimator& estimator) {
  using Clock = std::chrono::steady_clock;
  std::vector<Signals> stream = signals(stream_length);
  std::vector<double> nanoseconds;
  double time = 0.0;
  for (auto _ : state) {
    for (Signals& s : stream) {
      s.time = time += 0.001;
      const auto start = Clock::now();
      benchmark::DoNotOptimize(double{estimator.update(s).p_any_wheel});
      const auto end = Clock::now();
      nanoseconds.push_back(std::chrono::duration<double, std::nano>(end - start).count());
    }
  }
  std::sort(nanoseconds.begin(), nanoseconds.end());
  const auto percentile = [&](double p) {
    return nanoseconds[static_cast<std::size_t>(p * static_cast<double>(nanoseconds.size() - 1))];
  };
  state.counters["p50_ns"] = percentile(0.5);
  state.counters["p99_ns"] = percentile(0.99);
  state.counters["p99.9_ns"] = percentile(0.999);
  state.counters["max_ns"] = nanoseconds.back();
}

}  // namespace touchdown::bench
