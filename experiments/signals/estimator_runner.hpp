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

/// Runs an estimator on recorded runs: step by step as on a robot, or on a whole run at once.
class EstimatorRunner {
 public:
  explicit EstimatorRunner(std::unique_ptr<ContactEstimator> by_step)
      : estimator_(std::shared_ptr<ContactEstimator>(std::move(by_step))) {}
  explicit EstimatorRunner(WholeRunEstimator whole_run) : estimator_(std::move(whole_run)) {}
  /// `by_step` must outlive the runner.
  EstimatorRunner(ContactEstimator& by_step)  // NOLINT(google-explicit-constructor)
      : estimator_(std::shared_ptr<ContactEstimator>(std::shared_ptr<void>(), &by_step)) {}

  /// Resets the estimator and runs it on a whole run. `sense(k)` returns the signals of step k; it
  /// is called for recorded steps only. `take(k, belief)` is called for every step. At a step
  /// without a record the last belief holds.
  template <typename Sense, typename Take>
  void run_estimator(const RunSignals& run, const Sense& sense, const Take& take) const {
    const auto* by_step = std::get_if<std::shared_ptr<ContactEstimator>>(&estimator_);
    std::vector<Belief> beliefs;
    if (by_step == nullptr) {
      beliefs = whole_run_beliefs(run, sense);
    } else {
      (*by_step)->reset();
    }
    auto next = beliefs.begin();
    Belief belief;
    for (std::size_t k = 0; k < run.steps(); ++k) {
      if (has_record(run.signals[k])) {
        belief = by_step == nullptr ? *next++ : (*by_step)->update(sense(k));
      }
      take(k, belief);
    }
  }

 private:
  template <typename Sense>
  std::vector<Belief> whole_run_beliefs(const RunSignals& run, const Sense& sense) const {
    const SignalCheck check;  // as `ContactEstimator` does for one step
    std::vector<Signals> signals;
    signals.reserve(run.steps());
    for (std::size_t k = 0; k < run.steps(); ++k) {
      if (has_record(run.signals[k])) signals.push_back(check.without_unusable(sense(k)));
    }
    return std::get<WholeRunEstimator>(estimator_)(signals);
  }

  std::variant<std::shared_ptr<ContactEstimator>, WholeRunEstimator> estimator_;
};

/// The contact decision per wheel and step of an estimator that is reset and run on a whole run
/// with sensor noise. At a step without a record its last belief holds.
std::array<scoring::ContactSequence, models::wheel_count> decide(const EstimatorRunner& runner,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);

/// The same with probabilities, for each wheel and for the robot's views.
scoring::Prediction predict(const EstimatorRunner& runner, const RunSignals& run,
                            const NoiseRun& noise, const noise::SensorNoise& levels);

}  // namespace touchdown::experiments
