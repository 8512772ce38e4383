// No record, however absurd, leaves an estimator without a probability, or damaged for longer than
// a second. A value beyond its bound does what a missing one does, to the bit. `make fuzz` runs
// 100,000 sequences for each estimator, every other run a few.

#include "tests/experiments/estimators/random_sequences.hpp"

#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/draws.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

std::size_t sequences() {
  const char* const number = std::getenv("TOUCHDOWN_RANDOM_SEQUENCES");
  if (number != nullptr) return std::strtoull(number, nullptr, 10);
  return draws_all() ? 2000 : 50;
}

/// Signals like those that the recurrent networks were trained on. On others their memory may last
/// longer than a second.
std::vector<Signals> simulated_signals() {
  scenarios::Scenario scenario = scenarios::find_scenario("scenarios/stairs.yaml");
  scenario.end.duration = 6.0;
  return signals_of(scenarios::play(scenario, "mujoco"), {}, {}, scoring::SampleUnit::run).signals;
}

/// A synthetic run with some noise on its constant signals, because a signal that repeats itself to
/// the bit after a fault has stopped.
std::vector<Signals> synthetic_signals() {
  std::vector<Signals> signals = synthetic_run(3).signals;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1e-9);
  for (Signals& step : signals) {
    for (std::size_t i = 0; i < signal_count; ++i) member_of(step, i) += noise(random);
  }
  return signals;
}

TEST(RandomSequences, LeaveEveryRegisteredEstimatorWithProbabilities) {
  std::vector<std::string> fitted;
  for (const EstimatorEntry& entry : estimator_entries()) {
    if (entry.fits()) fitted.push_back(entry.name);
  }
  const FittedModels models =
      fit_models(synthetic_experiment(fitted), pointers_to({synthetic_run(first_fit_run)}));
  const RunSignals run = synthetic_run(3);
  for (const EstimatorEntry& entry : estimator_entries()) {
    const EstimatorSetup setup{
        .model = entry.fits() ? &models.at("mujoco").at(entry.name) : nullptr,
        .truth = &run.contact};
    const bool is_recurrent = entry.name.starts_with("nmn");
    RandomSequences random([&] { return entry.make(setup); },
                           is_recurrent ? simulated_signals() : synthetic_signals(), 39);
    // The recurrent networks take every fifth record, counted from the last gap.
    if (is_recurrent) random.restart_twin_at_gaps();
    random.expect_probabilities(sequences(), entry.name, !entry.knows.truth);
  }
}

/// What a user's estimator may do: sum whatever it gets. `NaN` would stay in the sum for ever.
class NaiveEstimator : public ContactEstimator {
 public:
  void reset() noexcept override { sum_ = 0.0; }

 private:
  const Belief& estimate(const Signals& signals) noexcept override {
    sum_ = 0.99 * sum_ + signals.leg[0].hip.velocity + signals.vertical_acceleration;
    const double p = 0.5 + 0.5 * sum_ / (1.0 + std::abs(sum_));
    belief_.wheel.fill({p, p >= 0.5});
    multiply_wheels(belief_);
    return belief_;
  }

  double sum_ = 0.0;
  Belief belief_;
};

TEST(RandomSequences, LeaveAUsersEstimatorWithProbabilities) {
  RandomSequences random([] { return std::make_unique<NaiveEstimator>(); }, synthetic_signals(),
                         39);
  random.expect_probabilities(sequences(), "naive");
}

TEST(RandomSequences, ReachEstimatorsOfWholeRunsAsNaN) {
  RunSignals run = synthetic_run(3, 100);
  run.signals[7].leg[1].wheel.velocity = -1e308;
  run.signals[8].angular_velocity.y() = 1e39;
  std::vector<Signals> seen;
  EstimatorRunner runner(WholeRunEstimator([&](std::span<const Signals> signals) {
    seen.assign(signals.begin(), signals.end());
    return std::vector<Belief>(signals.size());
  }));
  decide(runner, run, noise_run(run, {}), {});
  EXPECT_TRUE(std::isnan(seen[7].leg[1].wheel.velocity));
  EXPECT_TRUE(std::isnan(seen[8].angular_velocity.y()));
  EXPECT_EQ(seen[7].leg[1].wheel.torque, run.signals[7].leg[1].wheel.torque);
  EXPECT_EQ(seen[9].leg[1].wheel.velocity, run.signals[9].leg[1].wheel.velocity);
}

TEST(RandomSequences, DoNotReachAFit) {
  RunSignals absurd = synthetic_run(first_fit_run);
  for (const std::size_t k : {1000U, 2000U, 3000U}) {
    absurd.signals[k].leg[0].knee.torque = 1e308;
    absurd.signals[k].leg[1].wheel.torque = -1e39;
  }
  RunSignals missing = absurd;
  for (const std::size_t k : {1000U, 2000U, 3000U}) {
    missing.signals[k].leg[0].knee.torque = missing.signals[k].leg[1].wheel.torque = std::nan("");
  }
  const auto fitted = [&](const RunSignals& run) {
    const FittedModels models = fit_models(synthetic_experiment({"robust"}), {&run});
    return arrays_of(models.at("mujoco").at("robust"));
  };
  EXPECT_EQ(fitted(absurd), fitted(missing));
}

}  // namespace
}  // namespace touchdown::experiments
