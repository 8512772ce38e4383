#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "estimator/phase/filter.hpp"
#include "estimator/phase/fit.hpp"
#include "time_updates.hpp"

namespace touchdown {
namespace {

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

/// Lookups, online noise estimate, recursion.
void update_phase(benchmark::State& state) {
  PhaseFilter filter(phase_model());
  bench::time_updates(state, filter);
}
BENCHMARK(update_phase)->Name("update/phase");

void latency_phase(benchmark::State& state) {
  PhaseFilter filter(phase_model());
  bench::time_every_update(state, filter);
}
BENCHMARK(latency_phase)->Name("latency/phase")->Iterations(250);

}  // namespace
}  // namespace touchdown
