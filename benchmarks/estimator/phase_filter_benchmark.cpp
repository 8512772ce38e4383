#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/phase/filter.hpp"
#include "estimator/phase/fit.hpp"
#include "signals_for_benchmarks.hpp"

namespace touchdown {
namespace {

constexpr std::size_t stream_length = 4096;

const PhaseModel& phase_model() {
  static const PhaseModel model = [] {
    const std::vector<Signals> stream = bench::signals(30'000);
    std::vector<std::uint8_t> contact;
    for (const Signals& s : stream) contact.push_back(std::fmod(s.time, 1.0) > 0.8 ? 0 : 1);
    const std::vector<PhaseFitRun> runs = {{stream, {contact, contact}, false, {}, 0}};
    return fit_phase_model(runs, 1000.0, {});
  }();
  return model;
}

/// One `update` for both legs: lookups, online noise estimate, recursion. Compare with
/// `yardstick_fft_128` of the same run.
void update_phase(benchmark::State& state) {
  PhaseFilter filter(phase_model());
  std::vector<Signals> stream = bench::signals(stream_length);
  std::size_t i = 0;
  double time = 0.0;
  for (auto _ : state) {
    Signals& s = stream[i];
    s.time = time += 0.001;
    benchmark::DoNotOptimize(double{filter.update(s).p_any_wheel});
    i = (i + 1) % stream_length;
  }
}
BENCHMARK(update_phase)->Name("update/phase");

/// The time of every single update, clock included, as percentiles (ns).
void latency_phase(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  PhaseFilter filter(phase_model());
  std::vector<Signals> stream = bench::signals(stream_length);
  std::vector<double> nanoseconds;
  double time = 0.0;
  for (auto _ : state) {
    for (Signals& s : stream) {
      s.time = time += 0.001;
      const auto start = Clock::now();
      benchmark::DoNotOptimize(double{filter.update(s).p_any_wheel});
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
BENCHMARK(latency_phase)->Name("latency/phase")->Iterations(250);

}  // namespace
}  // namespace touchdown
