#pragma once

#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// What is believed after each of these steps, which are all that is heard of a run.
using WholeRunEstimator = std::function<std::vector<Belief>(std::span<const Signals> heard)>;

/// An estimator, reset, listens to a whole run step by step: to `hear(k)` at every step k of which
/// there is a record. `take(k, belief)` is called for all; where nothing is heard, the last belief
/// stands.
template <typename Hear, typename Take>
void evaluate(ContactEstimator& estimator, const RunSignals& run, const Hear& hear,
            const Take& take) {
  estimator.reset();
  Belief belief;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) belief = estimator.update(hear(k));
    take(k, belief);
  }
}

/// Likewise, all of the run at once.
template <typename Hear, typename Take>
void evaluate(const WholeRunEstimator& believe, const RunSignals& run, const Hear& hear, const Take& take) {
  std::vector<Signals> heard;
  heard.reserve(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) heard.push_back(hear(k));
  }
  const std::vector<Belief> beliefs = believe(heard);
  Belief belief;
  auto next = beliefs.begin();
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) belief = *next++;
    take(k, belief);
  }
}

/// An estimator that listens to runs: as on a robot, or to each of them at once.
class EstimatorRunner {
 public:
  explicit EstimatorRunner(std::unique_ptr<ContactEstimator> by_step) : how_(std::move(by_step)) {}
  explicit EstimatorRunner(WholeRunEstimator whole_run) : how_(std::move(whole_run)) {}

  /// As the functions above.
  template <typename Hear, typename Take>
  void run_estimator(const RunSignals& run, const Hear& hear, const Take& take) {
    if (const auto* by_step = std::get_if<std::unique_ptr<ContactEstimator>>(&how_)) {
      evaluate(**by_step, run, hear, take);
    } else {
      evaluate(std::get<WholeRunEstimator>(how_), run, hear, take);
    }
  }

 private:
  std::variant<std::unique_ptr<ContactEstimator>, WholeRunEstimator> how_;
};

/// The wheels' decisions of an estimator that, reset, listens to a whole run through noise. At a
/// step of which it does not hear, its last belief stands.
std::array<scoring::ContactSequence, models::wheel_count> decide(ContactEstimator& estimator,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);
std::array<scoring::ContactSequence, models::wheel_count> decide(EstimatorRunner& runner,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);

/// As above, with probabilities and the robot's views.
scoring::Prediction predict(ContactEstimator& estimator, const RunSignals& run,
                            const NoiseRun& noise, const noise::SensorNoise& levels);
scoring::Prediction predict(EstimatorRunner& runner, const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels);

}  // namespace touchdown::experiments
