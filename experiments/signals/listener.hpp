#pragma once

#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// What is believed after each of these steps, which are all that is heard of a run.
using BelieveRun = std::function<std::vector<Belief>(std::span<const Signals> heard)>;

/// An estimator, reset, listens to a whole run step by step: to `hear(k)` at every step k of which
/// there is a record. `take(k, belief)` is called for all; where nothing is heard, the last belief
/// stands.
template <typename Hear, typename Take>
void listen(ContactEstimator& estimator, const RunSignals& run, const Hear& hear,
            const Take& take) {
  estimator.reset();
  Belief belief;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (is_heard(run.signals[k])) belief = estimator.update(hear(k));
    take(k, belief);
  }
}

/// Likewise, all of the run at once.
template <typename Hear, typename Take>
void listen(const BelieveRun& believe, const RunSignals& run, const Hear& hear, const Take& take) {
  std::vector<Signals> heard;
  heard.reserve(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (is_heard(run.signals[k])) heard.push_back(hear(k));
  }
  const std::vector<Belief> beliefs = believe(heard);
  Belief belief;
  auto next = beliefs.begin();
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (is_heard(run.signals[k])) belief = *next++;
    take(k, belief);
  }
}

/// An estimator that listens to runs: as on a robot, or to each of them at once.
class Listener {
 public:
  explicit Listener(std::unique_ptr<ContactEstimator> by_step) : how_(std::move(by_step)) {}
  explicit Listener(BelieveRun at_once) : how_(std::move(at_once)) {}

  /// As the functions above.
  template <typename Hear, typename Take>
  void listen_to(const RunSignals& run, const Hear& hear, const Take& take) {
    if (const auto* by_step = std::get_if<std::unique_ptr<ContactEstimator>>(&how_)) {
      listen(**by_step, run, hear, take);
    } else {
      listen(std::get<BelieveRun>(how_), run, hear, take);
    }
  }

 private:
  std::variant<std::unique_ptr<ContactEstimator>, BelieveRun> how_;
};

/// The wheels' decisions of an estimator that, reset, listens to a whole run through noise. At a
/// step of which it does not hear, its last belief stands.
std::array<scoring::ContactSequence, models::wheel_count> decide(ContactEstimator& estimator,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);
std::array<scoring::ContactSequence, models::wheel_count> decide(Listener& listener,
                                                                 const RunSignals& run,
                                                                 const NoiseRun& noise,
                                                                 const noise::SensorNoise& levels);

/// As above, with probabilities and the robot's views.
scoring::Prediction predict(ContactEstimator& estimator, const RunSignals& run,
                            const NoiseRun& noise, const noise::SensorNoise& levels);
scoring::Prediction predict(Listener& listener, const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels);

}  // namespace touchdown::experiments
