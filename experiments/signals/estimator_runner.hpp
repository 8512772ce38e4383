#pragma once

#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// Returns one belief for each of these steps. The steps are all recorded steps of a run.
using WholeRunEstimator = std::function<std::vector<Belief>(std::span<const Signals> signals)>;

/// Resets an estimator and runs it on a whole run. `sense(k)` returns the signals of step k; it is
/// called for recorded steps only. `take(k, belief)` is called for every step. At a step without a
/// record the last belief holds.
template <typename Sense, typename Take>
void evaluate(ContactEstimator& estimator, const RunSignals& run, const Sense& sense,
              const Take& take) {
  estimator.reset();
  Belief belief;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) belief = estimator.update(sense(k));
    take(k, belief);
  }
}

/// The same for an estimator that gets the whole run at once.
template <typename Sense, typename Take>
void evaluate(const WholeRunEstimator& estimate, const RunSignals& run, const Sense& sense,
              const Take& take) {
  const SignalCheck check;  // as `ContactEstimator` does for one step
  std::vector<Signals> signals;
  signals.reserve(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) signals.push_back(check.without_unusable(sense(k)));
  }
  const std::vector<Belief> beliefs = estimate(signals);
  Belief belief;
  auto next = beliefs.begin();
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) belief = *next++;
    take(k, belief);
  }
}

/// Runs an estimator on recorded runs: step by step as on a robot, or on a whole run at once.
class EstimatorRunner {
 public:
  explicit EstimatorRunner(std::unique_ptr<ContactEstimator> by_step)
      : estimator_(std::move(by_step)) {}
  explicit EstimatorRunner(WholeRunEstimator whole_run) : estimator_(std::move(whole_run)) {}

  /// Works as `evaluate` above.
  template <typename Sense, typename Take>
  void run_estimator(const RunSignals& run, const Sense& sense, const Take& take) {
    if (const auto* by_step = std::get_if<std::unique_ptr<ContactEstimator>>(&estimator_)) {
      evaluate(**by_step, run, sense, take);
    } else {
      evaluate(std::get<WholeRunEstimator>(estimator_), run, sense, take);
    }
  }

 private:
  std::variant<std::unique_ptr<ContactEstimator>, WholeRunEstimator> estimator_;
};

/// The contact decision per wheel and step of an estimator that is reset and run on a whole run
/// with sensor noise. At a step without a record its last belief holds.
std::array<scoring::ContactSequence, models::wheel_count> decide(ContactEstimator& estimator,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);
std::array<scoring::ContactSequence, models::wheel_count> decide(EstimatorRunner& runner,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);

/// The same with probabilities, for each wheel and for the robot's views.
scoring::Prediction predict(ContactEstimator& estimator, const RunSignals& run,
                            const NoiseRun& noise, const noise::SensorNoise& levels);
scoring::Prediction predict(EstimatorRunner& runner, const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels);

}  // namespace touchdown::experiments
