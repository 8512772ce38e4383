#include <cmath>
#include <cstddef>
#include <tuple>

#include <benchmark/benchmark.h>

#include "estimator/decision/filter.hpp"
#include "estimator/evidence/filter.hpp"
#include "time_updates.hpp"

namespace touchdown {
namespace {

void fill(auto& numbers, float size) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = size * std::sin(static_cast<float>(i));
  }
}

/// Weights that activate every layer.
DecisionModel busy_network() {
  DecisionModel model;
  fill(model.first_weight, 0.2F);
  fill(model.second_weight, 0.3F);
  fill(model.last_weight, 0.5F);
  return model;
}

EvidenceModel wavy_curves() {
  EvidenceModel model;
  for (EvidenceCurve& curve : model.curve) fill(curve, 0.1F);
  return model;
}

DecisionModel with_servo_load(DecisionModel model) {
  model.servo_weight.resize(servo_weights);
  fill(model.servo_weight, 0.2F);
  return model;
}

EvidenceModel with_servo_load(EvidenceModel model) {
  model.servo_curve.resize(std::tuple_size_v<ServoLoadInputs>);
  for (EvidenceCurve& curve : model.servo_curve) fill(curve, 0.1F);
  return model;
}

/// As the shipped models have.
EvidenceCurveSets both_sets() { return {with_servo_load(wavy_curves()), wavy_curves()}; }

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

void update_decision_network(benchmark::State& state) {
  DecisionNetwork estimator(busy_network());
  bench::time_updates(state, estimator);
}
BENCHMARK(update_decision_network)->Name("update/decision_network");

void update_evidence(benchmark::State& state) {
  EvidenceCurves estimator(wavy_curves());
  bench::time_updates(state, estimator);
}
BENCHMARK(update_evidence)->Name("update/evidence_curves");

void update_network_with_servo_load(benchmark::State& state) {
  DecisionNetwork estimator(with_servo_load(busy_network()));
  bench::time_updates(state, estimator);
}
BENCHMARK(update_network_with_servo_load)->Name("update/decision_network_servo_load");

void update_curves_with_servo_load(benchmark::State& state) {
  EvidenceCurves estimator(both_sets());
  bench::time_updates(state, estimator);
}
BENCHMARK(update_curves_with_servo_load)->Name("update/evidence_curves_servo_load");

void latency_evidence(benchmark::State& state) {
  EvidenceCurves estimator(both_sets());
  bench::time_every_update(state, estimator);
}
BENCHMARK(latency_evidence)->Name("latency/evidence_curves")->Iterations(250);

}  // namespace
}  // namespace touchdown
