#include <benchmark/benchmark.h>

#include "estimator/force/load_filter.hpp"
#include "time_updates.hpp"

namespace touchdown {
namespace {

/// Computes nothing: what its update takes is the check of signals and belief.
class NoEstimator : public ContactEstimator {
 public:
  void reset() noexcept override {}

 private:
  const Belief& estimate(const Signals& /*signals*/) noexcept override { return belief_; }

  Belief belief_;
};

void update_nothing(benchmark::State& state) {
  NoEstimator estimator;
  bench::time_updates(state, estimator);
}
BENCHMARK(update_nothing)->Name("update/check_alone");

void update_load_filter(benchmark::State& state) {
  LoadFilter estimator;
  bench::time_updates(state, estimator);
}
BENCHMARK(update_load_filter)->Name("update/load_filter");

void latency_load_filter(benchmark::State& state) {
  LoadFilter estimator;
  bench::time_every_update(state, estimator);
}
BENCHMARK(latency_load_filter)->Name("latency/load_filter")->Iterations(250);

}  // namespace
}  // namespace touchdown
